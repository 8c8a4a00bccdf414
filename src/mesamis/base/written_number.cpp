// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/written_number.h"

#include <charconv>
#include <cmath>

namespace mesamis {

std::optional<double> written_number(std::string_view text) {
  const auto value = take_number(text);
  return text.empty() ? value : std::nullopt;
}

std::optional<double> take_number(std::string_view& text) {
  std::string_view digits = text;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return value;
}

bool take(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string quotable(std::string_view text) {
  std::string line(text.substr(0, kMostQuoted));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return line;
}

std::string quoted_text(std::string_view text) {
  std::string shown = "'";
  for (const char c : text.substr(0, kMostQuoted)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + "'";
}

}  // namespace mesamis
