// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

/// Numbers in the options and messages of this room.
namespace mesamis::detail {

/// The shortest decimals that read back as the same double.
inline std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// A text in quotes for a message of one line: cut after 60 characters, others than printable ASCII
/// as '?'.
inline std::string quoted_text(std::string_view text) {
  std::string shown = "'";
  for (const char c : text.substr(0, 60)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + "'";
}

/// Takes a finite number off the front of the text; none, and the text as it was, where there is
/// none.
inline std::optional<double> take_number(std::string_view& text) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (text.starts_with('+') && !text.starts_with("+-")) ++first;
  double value = 0;
  const auto [stop, error] = std::from_chars(first, last, value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return value;
}

/// Takes a word off the front of the text.
/// @return false, and the text as it was, where it begins otherwise.
inline bool take(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

}  // namespace mesamis::detail
