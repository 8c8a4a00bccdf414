// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "mesamis/surface/triangle_tree.h"

namespace mesamis {

inline Corners corners_of(const TriMesh& surface, const Triangle& t) {
  return {surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]};
}

/// A bound exceeds the true value by this factor at most.
inline constexpr double kDistanceSlack = 1.004;

/// When to stop looking, mm.
struct Enough {
  double below;  ///< > 0; what is nearer is not looked at any closer
  double above = std::numeric_limits<double>::infinity();  ///< farther is far enough
};

/// How far is any point of the triangle from the surface in the tree?
/// @param hint  see TriangleTree.
/// @return enough.below, or an upper bound above it that exceeds the true value by kDistanceSlack
///         at most, or a distance above enough.above that occurs.
double farthest_distance(const Corners& triangle, const TriangleTree& tree, const Enough& enough,
                         std::size_t& hint);

}  // namespace mesamis
