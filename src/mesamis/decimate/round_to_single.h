// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::decimate {

/// What rounding did to a surface.
struct RoundReport {
  std::int64_t collapsed = 0;  ///< edges collapsed: their points became equal, or triangles met
  std::int64_t moved = 0;      ///< points moved because another point had become equal to them
  std::int64_t flipped = 0;    ///< edges flipped in triangles that had lost their area, or that met
  std::int64_t flat = 0;       ///< triangles without area that are left
  double shift = 0;            ///< no part of the surface was moved farther than so, mm
};

/// Rounds the coordinates of a surface to single precision, which STL stores.
///
/// A closed 2-manifold stays one, and no two of its points are equal: a reader that joins equal
/// points gets the same triangles back. Points that become equal by rounding are joined if the
/// surface stays a manifold; otherwise one of them moves to the nearest free place. In triangles
/// that lose their area the longest edge is flipped where possible. Of triangles that meet then,
/// short edges are collapsed, and the longest edges of those without a short one are flipped: so
/// needles go that rounding bends over each other. Short are 2 distances between floats, and up to
/// 128 while some meet. Of any other surface
/// the points are rounded, and triangles with two equal corners are left out.
///
/// @param surface  n triangles, mm.
/// @param report   optional.
/// @return mm; each coordinate is a float's value, and no zero is negative.
/// @throws InputError  as require_sound(), or if a coordinate exceeds single precision.
///
/// O(n log n) for a surface that rarely meets itself.
TriMesh round_to_single(const TriMesh& surface, RoundReport* report = nullptr);

}  // namespace mesamis::detail::decimate
