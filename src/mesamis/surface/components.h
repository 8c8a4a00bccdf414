// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

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

/// @throws InputError  as require_sound. O(n log n).
SurfaceComponents find_components(const TriMesh& surface);

/// One surface per component, in the order of find_components. Points that belong to none are
/// left out, points that belong to several are repeated.
std::vector<TriMesh> split_components(const TriMesh& surface);

}  // namespace mesamis
