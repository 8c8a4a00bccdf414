// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// A spacing that the user gives in place of the file's: what all readers of scans say of it.
namespace mesamis::detail::files {

/// @param spacing  mm.
/// @throws InputError  naming the path, unless all three are positive and finite.
void require_positive_spacing(const std::filesystem::path& path, const Vec3& spacing);

/// The warning that another spacing than the file's was given.
/// @param stated  by the file, mm.
std::string spacing_is_replaced(const Vec3& stated);

}  // namespace mesamis::detail::files
