// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "mesamis/rooms.h"

/// Text that goes into files and messages.
namespace mesamis::detail::base {

/// Whether a text is UTF-8 (RFC 3629): no character in more bytes than it needs, no halves of
/// pairs, none beyond U+10FFFF.
bool is_utf8(std::string_view text) noexcept;

/// A text of any bytes as a line that a terminal shows as it is: control characters, among them
/// those of two bytes, and each byte that belongs to no character of UTF-8 become '?'.
std::string as_one_line(std::string_view text);

/// A text, or its beginning and its end where it is longer. Characters of UTF-8 stay whole.
/// @param longest  bytes, at least 5.
std::string shortened(const std::string& text, std::size_t longest);

}  // namespace mesamis::detail::base
