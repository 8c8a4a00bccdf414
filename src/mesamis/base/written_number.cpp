// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/written_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace mesamis::detail::base {

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

namespace {

/// With an exponent: 1.074e+09.
std::string scientific_text(double value, int digits) {
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1);
  return {text, end.ptr};
}

}  // namespace

std::string rounded_text(double value, int digits) {
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1);
  std::from_chars(text, end.ptr, value);
  return number_text(value);
}

std::string significant_text(double value, int digits) {
  constexpr double kSmall = 1e-4, kLarge = 1e6;
  if (value != 0 && !(std::abs(value) >= kSmall && std::abs(value) < kLarge)) {
    return scientific_text(value, digits);
  }
  const auto decimals_of = [&](double x) {
    const double size = std::abs(x);
    const int before = size > 0 ? static_cast<int>(std::floor(std::log10(size))) + 1 : 1;
    return std::max(digits - before, 0);
  };
  const auto write = [](double x, int decimals) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, x, std::chars_format::fixed, decimals);
    return std::string(text, end.ptr);
  };
  const int decimals = decimals_of(value);
  std::string written = write(value, decimals);
  // Rounding may carry: 9.96 becomes 10, which has a digit more before the point.
  const int fewer = decimals_of(written_number(written).value_or(value));
  if (fewer < decimals && value != 0) written = write(value, fewer);
  const std::size_t first = written.starts_with('-') ? 1 : 0;
  const std::size_t end = std::min(written.find('.'), written.size());
  if (end - first < 5) return written;
  for (std::size_t at = end; at > first + 3;) written.insert(at -= 3, " ");
  return written;
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

}  // namespace mesamis::detail::base
