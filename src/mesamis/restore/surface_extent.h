// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::restore {

/// How much surface an object has.
struct SurfaceExtent {
  double area = 0;        ///< mm^2
  double thin_share = 0;  ///< of the area: walls and gaps thinner than two voxels, 0 to 1
};

/// Measures the extent of a level set without a mesh, see level_area(). What is thin is looked for
/// at crossings with the grid lines, each of which stands for a piece of the area: there the image
/// leaves the level's side again within two voxels along the normal, inwards or outwards. A voxel
/// is long where the spacing is.
/// @param image  at least 2 voxels along each axis.
/// @param level  native units.
SurfaceExtent measure_extent(const VolumeView& image, double level);

}  // namespace mesamis::detail::restore
