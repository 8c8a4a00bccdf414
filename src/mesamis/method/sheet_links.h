// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/fit/bending.h"
#include "mesamis/surface/partition.h"

namespace mesamis::detail::method {

/// 1 for points where more than two materials meet.
std::vector<char> curve_points(const PartitionSurface& partition);

/// Which neighbours smooth the points of a partition's boundaries.
///
/// Where three materials meet along a curve, the boundary of one of them mostly goes on smoothly and
/// that between the other two ends at it: a bone among muscles, two vertebrae that touch within what
/// surrounds them. Of each three materials it is the one whose two sheets have the most equal normals
/// in the mean over their curves. If they turn by less than some 50 degrees there, points of the
/// curve are smoothed by all neighbours on the boundary of that material; else, and where more than
/// three materials meet, by those on curves alone.
/// @param surface   of the partition.
/// @param sides     of the partition: of each triangle.
/// @param on_curve  curve_points().
/// @return between Neighbors of the surface.
///
/// O(triangles), up to a logarithm.
Links sheet_links(const TriMesh& surface, std::span<const std::array<Index, 2>> sides,
                  const std::vector<char>& on_curve);

}  // namespace mesamis::detail::method
