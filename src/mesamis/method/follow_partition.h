// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/fit/fit_surface.h"
#include "mesamis/image/spline_image.h"
#include "mesamis/labels/pair_levels.h"
#include "mesamis/surface/partition.h"

namespace mesamis::detail::method {

/// Whether the image shows the edge between two materials: a contrast of at least four standard
/// deviations of the noise, and ten grey values.
/// @param noise  standard deviation in the image, grey values, >= 0.
bool shows_edge(const PairLevel& pair, double noise);

/// What the image shows at a point of a boundary.
struct BoundaryGuide {
  double level = 0;     ///< half way between both sides, unit of the image
  double contrast = 0;  ///< of the side behind above that in front; 0: the image shows no edge
};

/// The guides of a partition's points: none where more than two materials meet, and where the image
/// shows no edge.
/// @param pairs  measure_pair_levels() of the partition.
/// @param noise  as for shows_edge().
/// @return one per point.
///
/// O(triangles), up to a logarithm.
std::vector<BoundaryGuide> guides_of_points(const PartitionSurface& partition,
                                            const std::vector<PairLevel>& pairs, double noise);

/// The boundaries of chosen materials alone; all others become material 0.
/// @param chosen  not 0 for those, one per material.
/// @param guides  of the points; those of points that are left remain, for the sides as they are
///                then.
/// @return triangles and points in their order.
PartitionSurface only_chosen(const PartitionSurface& all, const std::vector<char>& chosen,
                             std::vector<BoundaryGuide>& guides);

/// Moves the boundaries of several objects towards the level sets of an image, each to its own
/// half maximum: follow_image() for a partition.
///
/// First all boundaries are faired (Taubin's filter, by at most 0.7 voxels), the curves where more
/// than two materials meet along themselves: labels have the steps of their voxels. Then points
/// with a guide follow the image, in two rounds of 0.7 voxels at most, and those without go with
/// their neighbours. Moves that would make boundaries meet are taken back.
/// @param partition  in the image's own axes, mm; without self-intersections.
/// @param image      in grey values.
/// @param guides     one per point, grey values.
/// @param noise      standard deviation in the image, grey values, >= 0.
/// @return the same triangles.
///
/// O(n log n) for n points. The same bits for any number of threads.
PartitionSurface follow_image(PartitionSurface partition, const SplineImage& image,
                              const std::vector<BoundaryGuide>& guides, double noise);

/// What boundaries are fitted to.
struct BoundaryAims {
  const std::vector<BoundaryGuide>& guides;  ///< of points
  std::span<const double> volumes{};         ///< of each material, mm^3, before the image is seen
  double reach = 0;                          ///< voxels, > 0, see FitOptions
  fit::SheetLevel sheets{};                  ///< of the image
};

/// Smooths the boundaries of several objects and fits them to an image, with what they share:
/// smooth_places(), fit_surface() and split_bends() for a partition.
/// @param partition, image, aims  as for follow_image(); of a guide its contrast counts.
/// @return the same triangles, or parts of them. Cost as fit_surface().
PartitionSurface fit_boundaries(PartitionSurface partition, const SplineImage& image,
                                const BoundaryAims& aims);

/// Smooths the boundaries of several objects, with what they share, and gives each its volume:
/// smooth_places(), split_bends() and keep_volumes() for a partition.
/// @param partition  in the grid's own axes, mm; without self-intersections; closed at its box.
/// @param volumes    of each material, mm^3.
/// @return the same triangles, or parts of them. Cost as moved_to().
PartitionSurface smooth_boundaries(PartitionSurface partition, const VoxelGrid& grid,
                                   std::span<const double> volumes);

}  // namespace mesamis::detail::method
