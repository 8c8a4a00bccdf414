// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/slice_source.h"

namespace mesamis::detail::image {

Volume read_slab(const SliceSource& source, Index first, Index count) {
  const VoxelGrid& whole = source.grid();
  Volume slab{whole, source.read(first, count)};
  slab.size[2] = count;
  slab.origin = whole.to_world({0, 0, first * whole.spacing.z});
  return slab;
}

Index slab_slices(const VoxelGrid& grid, Index around) {
  constexpr std::size_t kVoxels = std::size_t{1} << 26;
  const std::size_t slice = std::max<std::size_t>(grid.offset(0, 0, 1), 1);
  const auto slices = static_cast<Index>(std::min(kVoxels / slice, std::size_t{1} << 30));
  return std::max<Index>(1, std::min(std::max(slices, around), grid.size[2]));
}

std::vector<float> VolumeSlices::read(Index first, Index count) const {
  const auto begin =
      volume_.samples.begin() + static_cast<std::ptrdiff_t>(volume_.offset(0, 0, first));
  return {begin, begin + static_cast<std::ptrdiff_t>(volume_.offset(0, 0, count))};
}

}  // namespace mesamis::detail::image
