// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>

/// How the readers of this room say no: one line, the file first.
namespace mesamis::detail {

/// The parts one after another, numbers as an ostream writes them.
template <class... Part>
std::string say(const Part&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

/// Text of a file as it may be shown: one line of plain ASCII, other characters as '?'.
std::string shown(std::string_view text);

/// The same in quotes, cut after `longest` characters.
std::string in_quotes(std::string_view text, std::size_t longest = 60);

/// @throws InputError  "file: what", with control characters replaced, always.
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what);

/// Lower-case text; the ASCII letters only.
std::string lower(std::string_view text);

/// Without white space and zero bytes at both ends.
std::string_view trimmed(std::string_view text);

/// A whole number or a real number that fills the text, whatever the locale.
/// @return false  if there is none or anything follows it.
bool parse_number(std::string_view text, double& value);
bool parse_number(std::string_view text, std::int64_t& value);

}  // namespace mesamis::detail
