// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// What split_edges() leaves of a point's edges.
enum HeldPoint : char {
  kFree = 0,
  kHeld = 1,  ///< edges to others that are held stay whole
  kFixed = 2  ///< all its edges stay whole
};

/// Whether the edge between two points is to be split; called from several threads.
using SplitRule = std::function<bool(const Vec3&, const Vec3&)>;

/// How split_edges() goes about it.
struct SplitOptions {
  int rounds = 1;  ///< at most: a rule that never refuses, or needles, would be split for ever
  /// In the surface's unit. The edges of less high triangles are not split: these would be cut into
  /// thinner ones, down to rounding errors.
  double least_height = 0;
  /// A HeldPoint of each point; empty: all free. So of an open surface whose rim is held, the rim
  /// stays as it is, and triangles with three held corners are not cut.
  std::vector<char> held{};
};

/// Splits edges of a surface at their middles, round by round, where a rule asks for it. Each round
/// splits the longest edge of every triangle that has an edge to split, where both its triangles
/// are high enough. The surface stays where it is: new points lie on its triangles. A closed
/// surface stays closed.
/// @param surface  n points, mm or any unit.
/// @param rule     sees the end points in either order.
/// @param options  held of n points.
/// @return the points of the surface first, in their order; triangles in the order of those that
///         they are parts of.
/// @throws InputError  as require_sound().
///
/// O(m log m) for m triangles in the end, and one call of the rule per edge, which must not change
/// its mind.
TriMesh split_edges(TriMesh surface, const SplitRule& rule, SplitOptions options);

}  // namespace mesamis::detail::surface
