// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/volume.h"

namespace mesamis {

/// How many voxels away a voxel still counts in gaussian_smoothed(): four standard deviations,
/// rounded up.
/// @param sigma  standard deviation in voxels, 0 to 100.
Index gaussian_reach(double sigma);

/// Convolves a volume with a Gaussian, one axis of the grid after the other.
///
/// The kernel is truncated at four standard deviations and its weights add up to 1. The value at
/// the border continues beyond it, so that a constant stays constant. The voxel is the unit of
/// length along each axis, whatever the spacing.
///
/// @param volume  as many samples as voxels.
/// @param sigma   standard deviation in voxels, 0 to 100; 0: the volume as it is.
/// @return the smoothed volume on the same grid; the same bits for any number of threads.
/// @throws InputError  if sigma is out of range or the number of samples is wrong.
///
/// O(n sigma) for n voxels.
Volume gaussian_smoothed(Volume volume, double sigma);

}  // namespace mesamis
