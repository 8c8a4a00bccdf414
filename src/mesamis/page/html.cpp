// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/html.h"

#include <algorithm>
#include <array>

#include "mesamis/base/utf8.h"
#include "mesamis/files/xml_text.h"

namespace mesamis::detail::page {
namespace {

/// Elements that contain nothing and have no end tag.
bool is_void(const std::string& name) {
  constexpr std::array kVoid{"meta", "link", "img", "input", "br", "hr", "path", "rect", "image"};
  return std::find(kVoid.begin(), kVoid.end(), name) != kVoid.end();
}

/// SVG's own elements are closed in their tag where they are empty.
bool is_svg(const std::string& name) { return name == "path" || name == "rect" || name == "image"; }

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string safe;
  for (const char c : xml_escaped(as_one_line(text))) {
    if (c == '\'') {
      safe += "&#39;";
    } else {
      safe += c;
    }
  }
  return safe;
}

Html& Html::set(std::string_view attribute, std::string_view value) {
  attributes_ += " " + std::string(attribute) + "=\"" + html_escaped(value) + "\"";
  return *this;
}

Html& Html::flag(std::string_view attribute) {
  attributes_ += " " + std::string(attribute);
  return *this;
}

Html& Html::add(const Html& child) { return raw(child.str()); }

Html& Html::text(std::string_view words) { return raw(html_escaped(words)); }

Html& Html::raw(std::string_view markup) {
  inside_ += markup;
  return *this;
}

std::string Html::str() const {
  if (name_.empty()) return inside_;
  const std::string start = "<" + name_ + attributes_;
  if (is_void(name_)) return start + (is_svg(name_) ? "/>" : ">");
  return start + ">" + inside_ + "</" + name_ + ">";
}

Html element(std::string name, std::string_view words) {
  Html made(std::move(name));
  made.text(words);
  return made;
}

Html of_class(std::string name, std::string_view css_class) {
  Html made(std::move(name));
  made.set("class", css_class);
  return made;
}

}  // namespace mesamis::detail::page
