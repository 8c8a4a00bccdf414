// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mesamis/surface/tri_mesh.h"

/// Surfaces that are known as the zero of a function.
namespace mesamis {

/// Positive inside. At most 1-Lipschitz; near its zero the gradient is continuous and its norm at
/// least 0.2. Called by several threads at once.
using ImplicitField = std::function<double(const Vec3&)>;

/// The planes x, y, z = const of a grid, ascending, at least two each, mm.
using GridLines = std::array<std::vector<double>, 3>;

/// How far a surface is from the field's zero, from each point, side's middle and triangle's middle
/// along the field's gradient: at least the true distance of these. mm.
struct ImplicitError {
  double max = 0;
  double mean = 0;  ///< over the triangles' middles, weighted by area
};
ImplicitError implicit_error(const TriMesh& surface, const ImplicitField& inside);

/// The surface of {inside > 0} as triangles, fine where it is curved: the points lie on it (to
/// 2e-4 of a grid's step), and so do the middles of sides and triangles, within the tolerance.
///
/// Extracted on the grid like extract_solid(), which sets the topology: what is smaller than the
/// grid's bricks may be lost. Then sides and triangles that are not near enough are cut at a point
/// of the zero, until none is left or the cuts do not help (see implicit_error()).
///
/// @param lines      a grid around the object, which it does not touch.
/// @param tolerance  mm, > 0.
/// @return closed, 2-manifold, outward; empty if no node of the grid is inside.
/// @throws InputError  if the lines do not ascend or are too many for 32-bit indices, or the
///                     tolerance is not positive.
///
/// Only bricks near the zero are looked at: O(n) in the area, but for one value per 512 bricks.
TriMesh extract_implicit(const GridLines& lines, const ImplicitField& inside, double tolerance);

}  // namespace mesamis
