// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesamis/rooms.h"

namespace mesamis::detail::picture {

/// A coordinate with at most two decimals, without needless zeros, whatever the locale.
std::string svg_number(double value);

/// An element of an SVG document with what it contains. Texts and values are escaped.
class SvgElement {
 public:
  explicit SvgElement(std::string name) : name_(std::move(name)) {}

  SvgElement& set(std::string_view attribute, std::string_view value);
  SvgElement& set(std::string_view attribute, double value);
  SvgElement& add(SvgElement child);
  SvgElement& set_text(std::string_view text);

  /// @param depth  levels of indentation.
  std::string to_string(int depth = 0) const;

 private:
  std::string name_, attributes_, text_;  // attributes and text as they are in the file
  std::vector<SvgElement> children_;
};

}  // namespace mesamis::detail::picture
