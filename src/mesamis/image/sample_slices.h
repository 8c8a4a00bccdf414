// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/image/slice_source.h"

/// What is looked at of a scan that is too large to look at all of it.
namespace mesamis::detail::image {

/// Sums over the samples of a slice.
struct SliceSums {
  double sum = 0, squares = 0;
};

/// Of some slices.
std::vector<SliceSums> sums_of_slices(const VolumeView& slab);

/// All slices where they have no more voxels than `most`; else as many as that allows, at least
/// two, where the samples vary most.
SliceRange sample_slices(const VoxelGrid& whole, const std::vector<SliceSums>& sums,
                         std::size_t most);

/// The same of a scan in memory.
SliceRange sample_slices(const VolumeView& scan, std::size_t most);

}  // namespace mesamis::detail::image
