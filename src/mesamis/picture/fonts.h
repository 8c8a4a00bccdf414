// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "mesamis/rooms.h"

namespace mesamis::detail::picture {

/// The bytes of a TrueType font without serifs, DejaVu Sans, that is part of the library.
std::string_view font_bytes(bool bold) noexcept;

}  // namespace mesamis::detail::picture
