// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/fit/surface_moves.h"

namespace mesamis::detail::fit {

/// The edge that a point of a surface sees along its normal.
struct ImageEdge {
  double distance = 0;  ///< outwards, voxels
  double weight = 0;    ///< 0: there is none; 1: it is steep
};

/// What runs along the faces of sheets in an image, see restore::lift_thin_sheets(); grey values.
struct SheetLevel {
  double level = 0;     ///< half way between the object and its background, at thick places
  double contrast = 0;  ///< of these; not positive: sheets are like other places
};

/// What edge is looked for.
struct EdgeSearch {
  double contrast = 0;  ///< of the side behind above that in front, grey values; negative where the
                        ///< image rises outwards; not 0
  double reach = 0;     ///< voxels, > 0: an edge at its ends, or beyond, is none
  SheetLevel sheets{};  ///< of the image
};

/// Looks along a normal for an edge of the image.
///
/// The edge is where the image crosses the mean of its two sides, next to the place at which it
/// falls outwards most steeply; the farther a place, the steeper it must be. The sides are the
/// largest value within two voxels behind that place and the least within two voxels in front. A
/// side narrower than some four voxels, a thin wall or a gap, need not reach its own value, and half
/// of what it reaches lies outside of its faces: there the level is that of the sheets, if the side
/// clearly reaches beyond it.
/// @param normal  outwards, of length one.
///
/// O(reach): five evaluations of the image per voxel.
ImageEdge find_image_edge(const FollowSpace& space, const Vec3& point, const Vec3& normal,
                          const EdgeSearch& search);

}  // namespace mesamis::detail::fit
