// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::surface {

/// A bound exceeds the true value by this factor at most.
inline constexpr double kDistanceSlack = 1.004;

/// When a search for the farthest point may stop, mm.
struct Enough {
  double below;  ///< > 0; pieces nearer than this are not cut further
  double above = std::numeric_limits<double>::infinity();  ///< a farther point ends the search
};

/// The greatest distance of any point of the triangle from the surface in the tree.
/// @param hint  see TriangleTree.
/// @return an upper bound, which exceeds the true value by kDistanceSlack at most where it is above
///         enough.below; or a distance above enough.above that occurs.
double farthest_distance(const Corners& triangle, const TriangleTree& tree, const Enough& enough,
                         std::size_t& hint);

}  // namespace mesamis::detail::surface
