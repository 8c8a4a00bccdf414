// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/fit/surface_moves.h"

namespace mesamis::detail::fit {

/// The edge that a point of a surface sees along its normal.
struct ImageEdge {
  double distance = 0;  ///< outwards, voxels
  double weight = 0;    ///< 0: there is none; 1: it is steep
};

/// Looks along a normal for an edge of the image.
///
/// The edge is where the image crosses the mean of its two sides, next to the place at which it
/// falls outwards most steeply; the farther a place, the steeper it must be. The sides are the
/// largest value within two voxels behind that place and the least within two voxels in front.
/// @param normal    outwards, of length one.
/// @param contrast  of the side behind above that in front, grey values; negative where the image
///                  rises outwards; not 0.
/// @param reach     voxels, > 0: an edge at its ends, or beyond, is none.
///
/// O(reach): five evaluations of the image per voxel.
ImageEdge find_image_edge(const FollowSpace& space, const Vec3& point, const Vec3& normal,
                          double contrast, double reach);

}  // namespace mesamis::detail::fit
