// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "mesamis/rooms.h"

/// Units of length by the names that files give them.
namespace mesamis::detail::files {

/// Converts a unit of length to mm.
/// @param name  symbol or word, singular or plural, in either case: "um", "\u00b5m", "microns",
///              "micrometre", "nm", "mm", "cm", "m", "inch"; white space around it is ignored.
/// @return mm per unit; none for any other text.
/// @throws nothing
///
/// O(length of the name).
std::optional<double> mm_per_unit(std::string_view name);

}  // namespace mesamis::detail::files
