// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/decimate/editable_surface.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::decimate {

/// A flip: an edge gives way to one between the two points opposite to it. No point moves.
struct Flip {
  Index half_edge = kNoIndex;    ///< along the edge
  std::array<Index, 2> faces{};  ///< the triangles that change: of this half-edge and its opposite
  std::array<Corners, 2>
      after{};  ///< of each of these, mm, in the order of EditableSurface::flip()
  /// Between the triangles before and after, mm; infinity: one of them is turned over, seen along the
  /// common normal of both edges.
  double height = 0;
};

/// Describes a flip.
/// @param h  a half-edge for which may_flip() is true.
Flip describe_flip(const EditableSurface& surface, const std::vector<Vec3>& points, Index h);

/// Whether a flip makes the surface smoother, by 3 % and more: the sum, over the edge and the four
/// sides of the triangles beside it, of length times one less the cosine of the bend. An edge that
/// bends by less than 10 degrees stays; so does one if a triangle of a flip would be nearly degenerate
/// or turn by more than 75 degrees, or creases would grow, see spoils_shape().
/// @param normals  of each triangle, unit length or 0.
bool smooths(const EditableSurface& surface, const std::vector<Vec3>& points,
             const std::vector<Vec3>& normals, const Flip& flip);

}  // namespace mesamis::detail::decimate
