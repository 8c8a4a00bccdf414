// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/sample_slices.h"

#include <algorithm>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::image {

std::vector<SliceSums> sums_of_slices(const VolumeView& slab) {
  std::vector<SliceSums> sums(static_cast<std::size_t>(slab.size[2]));
  const std::size_t slice = slab.offset(0, 0, 1);
  parallel_for_each(sums.size(), [&](std::size_t k) {
    for (std::size_t n = k * slice; n < (k + 1) * slice; ++n) {
      const double sample = slab.samples[n];
      sums[k].sum += sample;
      sums[k].squares += sample * sample;
    }
  });
  return sums;
}

SliceRange sample_slices(const VoxelGrid& whole, const std::vector<SliceSums>& sums,
                         std::size_t most) {
  const auto slices = static_cast<Index>(sums.size());
  const auto slice = static_cast<double>(whole.offset(0, 0, 1));
  const auto count = std::clamp(
      static_cast<Index>(std::min(static_cast<double>(most) / slice, 1.0 * slices)), 2, slices);
  SliceRange best{0, count};
  double best_variance = -1;
  for (Index first = 0; first + count <= slices; ++first) {
    SliceSums all;
    for (Index k = first; k < first + count; ++k) {
      all.sum += sums[static_cast<std::size_t>(k)].sum;
      all.squares += sums[static_cast<std::size_t>(k)].squares;
    }
    const double voxels = slice * count, mean = all.sum / voxels;
    const double variance = all.squares / voxels - mean * mean;
    if (variance <= best_variance) continue;
    best_variance = variance;
    best.first = first;
  }
  return best;
}

SliceRange sample_slices(const VolumeView& scan, std::size_t most) {
  if (scan.samples.size() <= most) return {0, scan.size[2]};
  return sample_slices(scan, sums_of_slices(scan), most);
}

}  // namespace mesamis::detail::image
