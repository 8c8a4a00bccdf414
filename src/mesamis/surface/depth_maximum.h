// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// How far below a surface to look, and how closely.
struct DepthRange {
  double depth = 0;  ///< mm, >= 0: inward along the normal
  int samples = 1;   ///< >= 1: evenly on the way, beside the point itself
};

/// Finds the maximum of a P1 function between each point of a surface and a depth below it.
///
/// The function is sampled along the inward normal, see vertex_normals(). On a level set the
/// function itself is the same everywhere; its maximum below tells dense bone from thin.
///
/// @param mesh     n nodes, mm; fills a box. Outside it the nearest cell's value counts.
/// @param u        n values of any unit, finite.
/// @param surface  m points, mm; oriented outward, in the frame of the mesh.
/// @return m values in the unit of u.
/// @throws InputError  if the surface is not sound, see require_sound(), u is not one value per
///                     node, or the range is not one.
///
/// O(c + m s) for c cells and s samples, where the surface's points come in the order of the cells
/// that hold them. The same bits for any number of threads.
std::vector<double> max_below_surface(const TetMesh& mesh, std::span<const double> u,
                                      const TriMesh& surface, const DepthRange& range);

}  // namespace mesamis::detail::surface
