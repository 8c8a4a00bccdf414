// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::image {

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

/// Means around each voxel, of values that have weights.
class WeightedMeans {
 public:
  /// @param weighted  of each voxel its weight, >= 0, times its value.
  /// @param weights   on the same grid.
  /// @param sigma     of the Gaussian, voxels, 0 to 100.
  /// @param pull      > 0: a weight of the value 0, so that the mean is about 0 far from all others.
  /// @throws InputError  as gaussian_smoothed().
  WeightedMeans(Volume weighted, Volume weights, double sigma, double pull)
      : sums_(gaussian_smoothed(std::move(weighted), sigma)),
        weights_(gaussian_smoothed(std::move(weights), sigma)),
        pull_(pull) {}

  /// The mean around a voxel, in the unit of the values.
  double at(std::size_t n) const { return sums_.samples[n] / (weights_.samples[n] + pull_); }

 private:
  Volume sums_, weights_;
  double pull_;
};

}  // namespace mesamis::detail::image
