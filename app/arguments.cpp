// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

namespace mesamis {
namespace {

/// @param count  of the numbers; 0: any count above zero.
template <class Number>
std::vector<Number> parse_list(const std::string& text, std::size_t count,
                               const std::string& option) {
  std::vector<Number> numbers;
  const char* at = text.data();
  const char* end = at + text.size();
  bool more = true;  // a number must follow
  while (more) {
    Number value{};
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(static_cast<double>(value))) break;
    numbers.push_back(value);
    more = stop != end && *stop == ',';
    at = more ? stop + 1 : stop;
  }
  if (more || at != end || (count != 0 && numbers.size() != count)) {
    const std::string how_many = count == 0 ? "" : std::to_string(count) + " ";
    throw CLI::ValidationError(
        option, "expected " + how_many + "numbers with commas between, found '" + text + "'");
  }
  return numbers;
}

/// How many bytes follow this first one of a character; -1 if no character begins so.
int bytes_after(unsigned char first) {
  if (first < 0x80) return 0;
  if (first < 0xc2 || first > 0xf4) return -1;
  return first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
}

/// RFC 3629: no character in more bytes than it needs, no halves of pairs, none beyond U+10FFFF.
bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const int more = bytes_after(byte(0));
    if (more < 0 || text.size() <= static_cast<std::size_t>(more)) return false;
    for (int i = 1; i <= more; ++i) {
      if ((byte(static_cast<std::size_t>(i)) & 0xc0) != 0x80) return false;
    }
    if ((byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xed && byte(1) > 0x9f) ||
        (byte(0) == 0xf0 && byte(1) < 0x90) || (byte(0) == 0xf4 && byte(1) > 0x8f)) {
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(more) + 1);
  }
  return true;
}

}  // namespace

bool parse_number(const std::string& text, double& value) {
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc() && stop == end && std::isfinite(value);
}

std::vector<double> parse_numbers(const std::string& text, std::size_t count,
                                  const std::string& option) {
  return parse_list<double>(text, count, option);
}

std::vector<int> parse_integers(const std::string& text, std::size_t count,
                                const std::string& option) {
  return parse_list<int>(text, count, option);
}

std::vector<int> parse_integers(const std::string& text, const std::string& option) {
  return parse_list<int>(text, 0, option);
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

void require_utf8(const std::string& text, const std::string& option) {
  if (is_utf8(text)) return;
  throw CLI::ValidationError(option, "expected UTF-8, found something else");
}

std::string one_line(const std::string& text) {
  std::string line = text;
  while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.pop_back();
  for (char& c : line) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 32 || code == 127) c = ' ';
  }
  return line;
}

}  // namespace mesamis
