// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/restore/level_crossings.h"

namespace mesamis::detail::restore {

/// No way is followed further, voxels.
inline constexpr double kLongestWay = 6;

/// Measures how far an image stays on one side of a level along a straight way from a point of the
/// surface, looked at every half voxel from one voxel on.
/// @param step  the direction, one voxel long (voxel_step()), mm.
/// @return voxels, 0.5 to kLongestWay; 0 where the image ends before.
double way_on_one_side(const VolumeView& image, const SurfacePoint& from, const Vec3& step,
                       double level);

/// Where an object is thickest.
struct ThickPlaces {
  std::vector<SurfacePoint> points;  ///< in the order of the surface's
  /// Thickness below the thinnest of them, voxels, 0.5 to kLongestWay. 0: too few places could be
  /// judged, and the points are all of the surface.
  double least = 0;
};

/// Chooses the points of a surface where the object is thickest: there the image reaches the
/// object's own value, which thin walls never show through the blur.
///
/// From each point the way inwards is followed while the guide stays above the level, up to
/// kLongestWay. The points of the longest quarter of these ways are kept, if the guide stays below
/// the level for two and a half voxels outwards: beyond, another part of the object may begin.
/// @param guide   the image, smoothed, native units.
/// @param points  of the surface {guide = level}; those without a normal are left out.
/// @param level   native units.
/// @return all points, with a thickness of 0, if fewer than a hundred can be judged.
ThickPlaces thick_places(const VolumeView& guide, const std::vector<SurfacePoint>& points,
                         double level);

}  // namespace mesamis::detail::restore
