// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

/// Surfaces given as the zero of a function.
namespace mesamis::detail::phantom {

/// Positive inside. At most 1-Lipschitz; near its zero the gradient is continuous and its norm at
/// least 0.2. Called by several threads at once.
using ImplicitField = std::function<double(const Vec3&)>;

/// The planes x, y, z = const of a grid, ascending, at least two each, mm.
using GridLines = std::array<std::vector<double>, 3>;

/// The distance of a surface from a field's zero, mm.
struct ImplicitError {
  double max = 0;   ///< over points, midpoints of sides and centroids of triangles
  double mean = 0;  ///< over centroids of triangles, weighted by area
};

/// Measures how far a surface is from the field's zero, along the field's gradient from each point,
/// midpoint of a side and centroid: no less than the true distance of these.
/// @param surface  mm.
/// @param inside   in mm.
/// @return mm; zeros for a surface without points.
/// @throws InputError  as require_sound().
///
/// O(triangles), in parallel.
ImplicitError implicit_error(const TriMesh& surface, const ImplicitField& inside);

/// Triangulates the surface of {inside > 0}, finely where it is curved: the points lie on it (to
/// 2e-4 of a grid's step), and midpoints of sides and centroids of triangles within the tolerance.
///
/// The surface is first extracted on the grid like extract_solid(), which sets the topology: parts
/// smaller than the grid's bricks may be lost. Then sides and triangles that are not near enough
/// are split at a point of the zero, until none is left or splitting does not help (see
/// implicit_error()).
///
/// @param lines      a grid around the object, which it does not touch.
/// @param tolerance  mm, > 0.
/// @return closed, 2-manifold, outward; empty if no node of the grid is inside.
/// @throws InputError  if the lines do not ascend or are too many for 32-bit indices, or the
///                     tolerance is not positive.
///
/// Only bricks near the zero are evaluated, and one value per 512 bricks elsewhere:
TriMesh extract_implicit(const GridLines& lines, const ImplicitField& inside, double tolerance);

}  // namespace mesamis::detail::phantom
