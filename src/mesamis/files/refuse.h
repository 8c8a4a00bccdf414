// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "mesamis/base/message.h"

/// Errors of one line, the file first, and the parsing of words and numbers.
namespace mesamis::detail::files {

/// @return  a file's text as a message may show it: one line of plain ASCII, other characters as
/// '?'.
std::string shown(std::string_view text);

/// @return  the same in quotes, cut after `longest` characters.
std::string in_quotes(std::string_view text, std::size_t longest = 60);

/// Throws an InputError "file: what", one line of UTF-8, see as_one_line(),
/// whose second part has at most 400 bytes.
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what);

/// @return  the text with ASCII letters in lower case.
std::string lower(std::string_view text);
/// @return  the same in upper case.
std::string upper(std::string_view text);

/// @return  the last extension of a path in lower case, with its dot; empty if there is none.
std::string lower_extension(const std::filesystem::path& path);

/// @return  the text without white space and zero bytes at both ends.
std::string_view trimmed(std::string_view text);

/// Parses a real or a whole number that fills the text, in the C locale.
/// @return  false if there is none, anything follows it, or it is out of range.
bool parse_number(std::string_view text, double& value);
bool parse_number(std::string_view text, std::int64_t& value);

}  // namespace mesamis::detail::files
