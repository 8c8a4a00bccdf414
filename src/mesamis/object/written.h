// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

/// What a user writes down: numbers, and texts that messages repeat.
namespace mesamis {

/// A finite number, which may begin with +; nothing if the text is anything else. O(characters).
inline std::optional<double> written_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// As many characters of a text go into a message.
inline constexpr std::size_t kMostQuoted = 60;

/// The beginning of a text as part of a message, in one line. O(1).
inline std::string quotable(std::string_view text) {
  std::string line(text.substr(0, kMostQuoted));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return line;
}

}  // namespace mesamis
