// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/svg.h"

#include <charconv>

#include "mesamis/files/xml_text.h"

namespace mesamis::detail::picture {

std::string svg_number(double value) {
  char digits[400];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 2);
  std::string text(digits, end.ptr);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

SvgElement& SvgElement::set(std::string_view attribute, std::string_view value) {
  attributes_ += " " + std::string(attribute) + "=\"" + xml_escaped(value) + "\"";
  return *this;
}

SvgElement& SvgElement::set(std::string_view attribute, double value) {
  return set(attribute, svg_number(value));
}

SvgElement& SvgElement::add(SvgElement child) {
  children_.push_back(std::move(child));
  return *this;
}

SvgElement& SvgElement::set_text(std::string_view text) {
  text_ = xml_escaped(text);
  return *this;
}

std::string SvgElement::to_string(int depth) const {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  const std::string start = indent + "<" + name_ + attributes_;
  if (children_.empty() && text_.empty()) return start + "/>\n";
  if (children_.empty()) return start + ">" + text_ + "</" + name_ + ">\n";
  std::string inside;
  for (const SvgElement& child : children_) inside += child.to_string(depth + 1);
  return start + ">\n" + inside + indent + "</" + name_ + ">\n";
}

}  // namespace mesamis::detail::picture
