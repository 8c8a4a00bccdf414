// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/utf8.h"

#include <cstddef>

namespace mesamis::detail::base {
namespace {

/// How many bytes follow this first one of a character; -1 if no character begins so.
int bytes_after(unsigned char first) {
  if (first < 0x80) return 0;
  if (first < 0xc2 || first > 0xf4) return -1;
  return first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
}

/// The bytes of the character that a text begins with; 0 if none does.
std::size_t bytes_of_first(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const int more = bytes_after(byte(0));
  if (more < 0 || text.size() <= static_cast<std::size_t>(more)) return 0;
  const std::size_t count = static_cast<std::size_t>(more) + 1;
  for (std::size_t i = 1; i < count; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  if ((byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xed && byte(1) > 0x9f) ||
      (byte(0) == 0xf0 && byte(1) < 0x90) || (byte(0) == 0xf4 && byte(1) > 0x8f)) {
    return 0;
  }
  return count;
}

/// U+0000 to U+001F, U+007F to U+009F.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7f;
  return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

}  // namespace

bool is_utf8(std::string_view text) noexcept {
  while (!text.empty()) {
    const std::size_t count = bytes_of_first(text);
    if (count == 0) return false;
    text.remove_prefix(count);
  }
  return true;
}

std::string as_one_line(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  while (!text.empty()) {
    const std::size_t count = bytes_of_first(text);
    const bool shown = count > 0 && !is_control(text.substr(0, count));
    if (shown) {
      line += text.substr(0, count);
    } else {
      line += '?';
    }
    text.remove_prefix(count > 0 ? count : 1);
  }
  return line;
}

std::string shortened(const std::string& text, std::size_t longest) {
  constexpr std::string_view kGap = " ... ";
  if (text.size() <= longest) return text;
  const auto within = [&text](std::size_t at) { return (text[at] & 0xc0) == 0x80; };
  const std::size_t kept = longest - kGap.size();
  std::size_t head = kept * 2 / 3, tail = text.size() - (kept - head);
  while (head > 0 && within(head)) --head;
  while (tail < text.size() && within(tail)) ++tail;
  return text.substr(0, head).append(kGap).append(text, tail);
}

}  // namespace mesamis::detail::base
