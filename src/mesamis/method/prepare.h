// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/image/spline_image.h"
#include "mesamis/image/volume.h"
#include "mesamis/method/measured_image.h"
#include "mesamis/method/parameters.h"
#include "mesamis/method/settings.h"

namespace mesamis {

/// The image as the method works on it, and what was chosen for the run.
struct Prepared {
  Parameters parameters;
  MeasuredImage measured;
  Volume grey;  ///< the volume, restored, in grey values
  /// The same between the voxels: the spline through what the bounds have not cut yet.
  SplineImage image;
};

/// Counts the nodes of the first grid along each axis: every stride-th voxel, at least two.
/// @param voxels  at least 1 along each axis.
/// @param stride  voxels, at least 1.
/// @throws nothing
std::array<Index, 3> first_grid_size(const std::array<Index, 3>& voxels,
                                     const std::array<Index, 3>& stride);

/// Chooses what the settings leave open from the volume, restores it, and maps it to grey values.
///
/// The order is that of need: the object's edges give the window, the clamped image the level, its
/// noise and blur, the restored image the number of cells and the price of edges.
/// @param volume    native units, see require_usable().
/// @param settings  valid, see require_valid().
/// @throws InputError  if the window holds none of the samples, or does not hold the level; for a
///                     solid, if its level is not between the least and the greatest sample (which
///                     is checked first), or is to be found and nothing stands out of the noise.
///
/// O(voxels); two copies of the samples at a time.
Prepared prepare_image(const VolumeView& volume, const Settings& settings);

}  // namespace mesamis
