// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/xml_text.h"

#include <algorithm>

namespace mesamis::detail::files {
namespace {

/// The bytes of the UTF-8 character that begins the text; 0 if it is none that XML allows.
std::size_t xml_character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) {
    const bool allowed = first >= 0x20 || first == '\t' || first == '\n' || first == '\r';
    return allowed ? 1 : 0;
  }
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  unsigned code = first & (0xffu >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr unsigned kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  const bool allowed = first >= 0xc2 && first < 0xf5 && code >= kSmallest[size] &&
                       code <= 0x10ffff && !surrogate && code != 0xfffe && code != 0xffff;
  return allowed ? size : 0;
}

std::string_view escaped_character(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    default:
      return {};
  }
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t size = xml_character_size(text);
    const std::string_view escaped = escaped_character(text.front());
    if (size == 0) {
      out += '?';
    } else {
      out += escaped.empty() ? text.substr(0, size) : escaped;
    }
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return out;
}

}  // namespace mesamis::detail::files
