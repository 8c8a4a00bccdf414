// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/image/spline_image.h"
#include "mesamis/labels/pair_levels.h"
#include "mesamis/surface/partition.h"

namespace mesamis {

/// Whether the image shows the edge between two materials: a contrast of at least four standard
/// deviations of the noise, and ten grey values.
/// @param noise  standard deviation in the image, grey values, >= 0.
/// @throws nothing
bool shows_edge(const PairLevel& pair, double noise);

/// Moves the boundaries of several objects towards the level sets of an image, each to its own
/// half maximum: follow_image() for a partition.
///
/// First all boundaries are faired (Taubin's filter, by at most 0.7 voxels), the curves where more
/// than two materials meet along themselves: labels have the steps of their voxels. Then those
/// whose edge the image shows follow it, in two rounds of 0.7 voxels at most. Moves that would make
/// boundaries meet are taken back.
/// @param partition  in the image's own axes, mm; without self-intersections.
/// @param image      in grey values.
/// @param pairs      measure_pair_levels() of both.
/// @param noise      standard deviation in the image, grey values, >= 0.
/// @return the same triangles.
/// @throws nothing
///
/// O(n log n) for n points. The same bits for any number of threads.
PartitionSurface follow_image(PartitionSurface partition, const SplineImage& image,
                              const std::vector<PairLevel>& pairs, double noise);

}  // namespace mesamis
