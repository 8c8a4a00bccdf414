// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace mesamis {

/// What the machine can still give to this process: what the system counts as available, within
/// the limit of the process's control group. Files kept in memory count as available.
/// @return bytes; nothing where the system does not tell. Never throws.
std::optional<double> available_memory();

}  // namespace mesamis
