// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>

#include "mesamis/rooms.h"

/// Text in memory, cut without copies.
namespace mesamis::detail::files {

/// The next word between white space, taken off the front of the text; empty at the end.
inline std::string_view take_word(std::string_view& text) {
  constexpr std::string_view kBlank = " \t\r\n\v\f";
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlank));
  text.remove_prefix(word.size());
  return word;
}

/// Whether a character ends a line, alone or before another.
inline bool ends_line(char c) { return c == '\n' || c == '\r'; }

/// The next line without its end (\n, \r\n, \r\r\n or, as old Macs wrote it, \r), taken off the front
/// of the text; false at the end.
inline bool take_line(std::string_view& text, std::string_view& line) {
  if (text.empty()) return false;
  const auto at = std::find_if(text.begin(), text.end(), ends_line);
  line = text.substr(0, static_cast<std::size_t>(at - text.begin()));
  text.remove_prefix(line.size());
  const std::size_t returns = std::min(text.find_first_not_of('\r'), text.size());
  const bool newline = returns < text.size() && text[returns] == '\n';
  text.remove_prefix(newline ? returns + 1 : std::min<std::size_t>(1, text.size()));
  return true;
}

}  // namespace mesamis::detail::files
