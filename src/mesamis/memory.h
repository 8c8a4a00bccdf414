// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/settings.h"

namespace mesamis {

/// About how much memory mes_amis() takes, bytes, beside the volume it is given. The largest of
/// three: preparing the image (by the voxel), the first pass (by the node of its grid), and the
/// adapted meshes (by the cell). Measured, with a little to spare: see docs/performance.md.
/// @param settings  valid; where max_tets is left to be chosen, the most that could be counts.
/// @throws InputError  as cropped_size().
double memory_needed(const Volume& volume, const Settings& settings);

/// The settings' stride, made larger, always along the axis where it is shortest in mm, until a
/// run fits into so many bytes.
/// @return nothing if no stride up to 8 helps.
std::optional<std::array<Index, 3>> stride_that_fits(const Volume& volume, Settings settings,
                                                     double bytes);

}  // namespace mesamis
