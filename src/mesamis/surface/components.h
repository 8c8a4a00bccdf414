// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// The parts of a surface that are connected by edges.
struct SurfaceComponents {
  struct Size {
    std::int64_t triangles = 0;
    double volume = 0;  ///< mm^3, signed: negative for the wall of a cavity
    double area = 0;    ///< mm^2
  };
  std::vector<Size> sizes;         ///< largest absolute volume first
  std::vector<Index> of_triangle;  ///< index into sizes; kNoIndex for a degenerate triangle
};

/// The order in which components come: the largest absolute volume first, of equal ones the first.
/// @return the index of each in `sizes`.
///
/// O(n log n) for n components.
std::vector<Index> largest_first(std::span<const SurfaceComponents::Size> sizes);

/// Finds the components of a surface and measures them.
/// @param surface      n triangles, mm.
/// @throws InputError  as require_sound().
///
/// O(n log n).
SurfaceComponents find_components(const TriMesh& surface);

/// Makes one surface per component, in the order of find_components(). Points of no component are
/// left out, points of several are repeated.
/// @param surface      n triangles, mm.
/// @throws InputError  as require_sound().
///
/// O(n log n).
std::vector<TriMesh> split_components(const TriMesh& surface);

}  // namespace mesamis::detail::surface
