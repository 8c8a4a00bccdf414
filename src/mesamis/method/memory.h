// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/method/settings.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::method {

/// Predicts how much memory mes_amis() takes beside the volume it is given. The largest of three
/// counts: preparing the image (by the voxel), the first pass (by the node of its grid), and the
/// adapted meshes (by the cell), or of a preview its surface (by the triangle, of which no header
/// tells). Measured, with a little to spare: see docs/performance.md.
/// @param settings  valid; where max_tets is to be chosen, the most that could be chosen counts.
/// @return bytes.
/// @throws InputError  as cropped_size().
double memory_needed(const VoxelGrid& volume, const Settings& settings);

/// Enlarges the settings' stride, always along the axis where it is shortest in mm, until a run
/// fits into so many bytes.
/// @return voxels along each axis; nothing if no stride up to 8 helps.
/// @throws InputError  as cropped_size().
std::optional<std::array<Index, 3>> stride_that_fits(const VoxelGrid& volume, Settings settings,
                                                     double bytes);

/// Refuses a run that would not fit, before it starts.
/// @param limit_gb     that it may take, 10^9 bytes; 0: available_memory().
/// @param still_taken  bytes that will be taken before it starts, such as for samples that are
///                     still to be read.
/// @throws InputError  if it does not fit: what the run needs, what there is, and the stride that
///                     fits; and as cropped_size().
void require_memory(const VoxelGrid& volume, const Settings& settings, double limit_gb,
                    double still_taken = 0);

}  // namespace mesamis::detail::method
