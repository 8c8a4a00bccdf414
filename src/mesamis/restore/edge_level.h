// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/restore/level_crossings.h"

namespace mesamis {

/// Measures the value of a blurred image at an object's surface, by a fit of an edge with a shell
/// behind it (cortical bone), one to two and a half voxels thick, to the median profile along the
/// normals of the points.
///
/// Without a shell this is the level of half maximum. Where the blur mixes a thin dense shell with
/// the lighter core behind it, the half maximum of the values seen on the two sides
/// (measure_contrast()) is too low.
/// @param volume  native values.
/// @param points  within a voxel of the edge: a surface at a level that is near the one sought.
/// @return native units; nothing if fewer than a hundred points have a normal, or the fit leaves a
///         root mean square of more than a hundredth of the edge's height.
/// @throws nothing
///
/// O(points).
std::optional<double> measure_edge_level(const VolumeView& volume,
                                         const std::vector<SurfacePoint>& points);

}  // namespace mesamis
