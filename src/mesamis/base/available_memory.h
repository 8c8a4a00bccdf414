// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "mesamis/rooms.h"

namespace mesamis::detail::base {

/// What the machine can still give to this process: what the system counts as available, within
/// the limits of the process's control group and of those above it (versions 1 and 2). Files kept
/// in memory count as available.
/// @param root  the folder that holds the system's own files proc and sys; another one for tests.
/// @return bytes, 0 at least; nothing where the system does not tell.
std::optional<double> available_memory(const std::filesystem::path& root = "/");

/// What a caller may take: his limit if he has one, else available_memory().
/// @param limit_gb  10^9 bytes; 0: none.
/// @return bytes; nothing where there is no limit and the system does not tell.
std::optional<double> memory_limit(double limit_gb);

}  // namespace mesamis::detail::base
