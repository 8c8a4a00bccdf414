// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/restore/edge_profile.h"
#include "mesamis/restore/level_crossings.h"

namespace mesamis::detail::restore {

/// Measures the edge of a blurred image at an object's surface, by a fit of an edge with a shell
/// behind it (cortical bone, or a wall with what is behind it) to the median profile along the
/// normals of the points.
///
/// EdgeModel::level() is the image's value at the surface. Without a shell it is the level of half
/// maximum. Where the blur mixes a thin dense shell with the lighter core behind it, the half
/// maximum of the values seen on the two sides (measure_contrast()) is too low.
/// @param volume  native values.
/// @param points  within a voxel of the edge: a surface at a level that is near the one sought.
/// @param thickest  see fit_edge_model().
/// @return native units; nothing if fewer than a hundred points have a normal, or the fit leaves a
///         root mean square of more than a fiftieth of the edge's height.
std::optional<EdgeModel> measure_edge(const VolumeView& volume,
                                      const std::vector<SurfacePoint>& points,
                                      double thickest = kThickestShell);

}  // namespace mesamis::detail::restore
