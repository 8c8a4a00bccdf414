// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/restore/level_crossings.h"

namespace mesamis {

/// Chooses the points of a surface where the object is thickest: there the image reaches the
/// object's own value, which thin walls never show through the blur.
///
/// From each point the way inwards is followed while the guide stays above the level, up to six
/// voxels. The points of the longest quarter of these ways are kept, if the guide stays below the
/// level for two and a half voxels outwards: beyond, another part of the object may begin.
/// @param guide   the image, smoothed, native units.
/// @param points  of the surface {guide = level}; those without a normal are left out.
/// @param level   native units.
/// @return in the order of the points; all of them if fewer than a hundred can be judged.
/// @throws nothing
///
/// O(points).
std::vector<SurfacePoint> thick_places(const VolumeView& guide,
                                       const std::vector<SurfacePoint>& points, double level);

}  // namespace mesamis
