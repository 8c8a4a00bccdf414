// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/image/spline_image.h"
#include "mesamis/surface/partition.h"

namespace mesamis::detail::labels {

/// What the image shows at the boundary between two materials.
struct PairLevel {
  std::array<Index, 2> sides{};  ///< as in PartitionSurface::sides
  double level = 0;              ///< half way between both sides, unit of the image
  double contrast = 0;           ///< of the first side above the second; negative: it is darker
  std::size_t points = 0;        ///< of the boundary, that were looked at
};

/// Measures the half maximum of each boundary of a partition.
///
/// At each point of the boundary the image is sampled along the normal up to three voxels to both
/// sides. The plateau of the brighter side is the largest of the samples from 0.75 voxels on, that
/// of the darker side the least, so that the skin of a bone counts and not the marrow behind it.
/// The level is the mean of both plateaus' medians.
/// @param partition  in the image's own axes, mm, see extract_partition_on_grid().
/// @param image      any unit.
/// @return one for each pair of sides that occurs, in increasing order, without the border of the
///         box. Points where more than two materials meet are left out.
///
/// The same bits for any number of threads.
std::vector<PairLevel> measure_pair_levels(const PartitionSurface& partition,
                                           const SplineImage& image);

/// The pair of materials that each point lies between.
/// @return indices into `pairs`; kNoIndex where more than two materials meet, at the border of the
///         box and for other pairs.
///
/// O(triangles), up to a logarithm.
std::vector<Index> pairs_of_points(const PartitionSurface& partition,
                                   const std::vector<PairLevel>& pairs);

}  // namespace mesamis::detail::labels
