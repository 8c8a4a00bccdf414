// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/image/slice_source.h"
#include "mesamis/image/volume.h"

namespace mesamis::detail::phantom {

/// What a scanner does to an image, in the order in which it is applied.
struct DegradeOptions {
  double blur = 0;         ///< standard deviation of a Gaussian, voxels of each axis, 0 to 100
  double speckle = 0;      ///< x becomes x (1 + speckle n), n standard normal; >= 0
  double noise = 0;        ///< standard deviation of Gaussian noise, grey values, >= 0
  double salt_pepper = 0;  ///< share of the voxels that become salt or pepper, 0 to 1
  double pepper = 0, salt = 255;  ///< grey values, each for half of these voxels
  std::uint64_t seed = 1;
};

/// Checks the options.
/// @throws InputError  naming the first value out of range.
void require_valid(const DegradeOptions& options);

/// Blurs an image and adds noise. Each random number is a hash of the seed, the voxel and the kind
/// of noise: the same bytes for any number of threads, and the noise of one kind does not depend on
/// another.
///
/// The Gaussian is cut off at four standard deviations; beyond the border the nearest voxel is
/// repeated, so that a constant image stays constant.
/// @param volume  grey values; taken over, pass it with std::move() to save the copy.
/// @throws InputError  as require_valid().
/// O(voxels blur).
Volume degrade(Volume volume, const DegradeOptions& options);

/// A degraded image, made a few slices at a time: to the bit those of degrade().
class DegradedSlices : public SliceSource {
 public:
  /// @param sharp  the image; must live as long as this object.
  /// @throws InputError  as require_valid().
  DegradedSlices(const SliceSource& sharp, const DegradeOptions& options);
  DegradedSlices(const SliceSource&& sharp, const DegradeOptions& options) = delete;
  const VoxelGrid& grid() const override { return sharp_.grid(); }
  /// Reads the slices that the blur reaches on both sides, too: these are the cost of slabs.
  std::vector<float> read(Index first, Index count) const override;
  /// How many slices are worth reading at once, see slab_slices().
  Index slab() const;

 private:
  const SliceSource& sharp_;
  DegradeOptions options_;
};

}  // namespace mesamis::detail::phantom
