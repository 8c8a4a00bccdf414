// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/settings.h"

namespace mesamis {

/// What the machine can still give to this process, bytes: what the system counts as available,
/// within the limit of the process's control group. Nothing where that cannot be told.
std::optional<double> available_memory();

/// Refuses a run that would not fit, before it starts.
/// @param limit_gb  that it may take, 10^9 bytes; 0: what is available.
/// @throws InputError  saying what the run needs, what there is, and the stride that fits.
void require_memory(const Volume& volume, const Settings& settings, double limit_gb);

}  // namespace mesamis
