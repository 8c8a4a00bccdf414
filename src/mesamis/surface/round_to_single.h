// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// What rounding did to a surface.
struct RoundReport {
  std::int64_t collapsed = 0;  ///< points that met a neighbour and were joined with it
  std::int64_t moved = 0;      ///< points that met a stranger and were moved beside it
  std::int64_t flipped = 0;    ///< sides turned in triangles that had lost their area
  std::int64_t flat = 0;       ///< triangles left that have none
  double shift = 0;            ///< the farthest a point that is left was moved, mm
};

/// The surface with coordinates that single precision holds, as STL has them.
///
/// A closed 2-manifold stays one, and no two of its points lie at the same place: a reader that
/// joins equal points gets the same triangles back. Points that rounding brings together
/// are joined where the surface stays a manifold; otherwise one of them moves to the
/// nearest free place. Triangles that lose their area are turned away where possible. Of any other
/// surface the points are rounded, and triangles with two corners at one place are left out.
/// @throws InputError  as require_sound, or if a coordinate exceeds single precision.
TriMesh round_to_single(const TriMesh& surface, RoundReport* report = nullptr);

}  // namespace mesamis
