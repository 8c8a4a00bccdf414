// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesamis/rooms.h"

/// HTML from texts that may hold anything: the one place where markup is written.
namespace mesamis::detail::page {

/// A text as HTML and SVG take it, between tags and in attributes between double quotes: the five
/// characters that mean something there are written as entities; control characters and bytes that
/// are no UTF-8 become '?'.
std::string html_escaped(std::string_view text);

/// An element with what it contains. Names of elements and attributes are the program's own; values
/// and texts are escaped.
class Html {
 public:
  /// @param name  of the element; empty: what it contains alone.
  explicit Html(std::string name = {}) : name_(std::move(name)) {}

  Html& set(std::string_view attribute, std::string_view value);
  /// An attribute without a value.
  Html& flag(std::string_view attribute);
  Html& add(const Html& child);
  Html& text(std::string_view words);
  /// Markup that was made elsewhere of escaped texts, scripts and styles of the program.
  Html& raw(std::string_view markup);

  bool is_empty() const { return inside_.empty(); }
  std::string str() const;

 private:
  std::string name_, attributes_, inside_;
};

/// An element that holds a text alone.
Html element(std::string name, std::string_view words);

/// An element of a class.
Html of_class(std::string name, std::string_view css_class);

}  // namespace mesamis::detail::page
