// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mesamis/rooms.h"

/// Numbers that a user writes down, and texts of his that messages repeat.
namespace mesamis::detail::base {

/// A finite number, in any unit and any of the usual spellings: 5, +5, .5, 05, 5e3; nothing if the
/// text is anything else, also with blanks. The decimal point is a point in any locale.
std::optional<double> written_number(std::string_view text);

/// Takes a number, in any unit, as written_number() reads it, off the front of a text, as long a
/// one as possible; nothing, and the text as it was, if it begins otherwise.
std::optional<double> take_number(std::string_view& text);

/// Takes a word off the front of a text; false, and the text as it was, if it begins otherwise.
bool take(std::string_view& text, std::string_view word);

/// The shortest decimals that read back as the same number.
/// @param value  in any unit.
std::string number_text(double value);

/// As number_text(), rounded to so many significant digits: for messages about computed numbers.
/// @param value   in any unit, finite.
/// @param digits  1 to 17.
std::string rounded_text(double value, int digits = 6);

/// A number in decimals, rounded to so many significant digits: 0.30, 12, 803, 105 158 (groups of
/// three from 10 000 on). Digits before the point are not cut: 105158 keeps six. Below 1e-4 and
/// from a million on with an exponent: 6.25e-32.
/// @param value   in any unit, finite.
/// @param digits  1 to 17.
std::string significant_text(double value, int digits);

/// As many characters of a text go into a message.
inline constexpr std::size_t kMostQuoted = 60;

/// The beginning of a text as part of a message, in one line: control characters as blanks.
std::string quotable(std::string_view text);

/// The beginning of a text in single quotes, others than printable ASCII as '?'.
std::string quoted_text(std::string_view text);

}  // namespace mesamis::detail::base
