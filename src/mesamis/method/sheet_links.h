// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/fit/bending.h"
#include "mesamis/surface/partition.h"

namespace mesamis::detail::method {

/// Of the boundaries that go on through a curve: both, or the smoothest alone.
enum class Through { kBoth, kSmoothest };

/// Which neighbours smooth the points of a partition's boundaries.
///
/// Where three materials meet along a curve, the boundary of one or two of them mostly goes on
/// smoothly: that of a bone at which the boundary between two muscles ends, or those of two muscles
/// that touch, where the background between them ends in a cusp. A boundary goes on if its two
/// sheets turn by less than some 58 degrees in the mean over the curves of the same materials, as
/// those of three equal wedges turn by 60; a second one, if they turn by less than some 53.
///
/// Points of a curve are smoothed by the neighbours on each boundary that goes on. With kBoth, if
/// one alone goes on, the neighbours on curves smooth them, too. Where none does, and where more
/// than three materials meet, only these do.
/// @param surface   of the partition.
/// @param sides     of the partition: of each triangle.
/// @param on_curve  curve_points().
/// @return between Neighbors of the surface.
///
/// O(triangles), up to a logarithm.
Links sheet_links(const TriMesh& surface, std::span<const std::array<Index, 2>> sides,
                  const std::vector<char>& on_curve, Through which = Through::kBoth);

}  // namespace mesamis::detail::method
