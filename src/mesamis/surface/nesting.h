// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/surface/components.h"

namespace mesamis {

/// Which component of a closed surface lies in which.
struct Nesting {
  std::vector<Index> parent;  ///< the smallest component around each; kNoIndex: none
  std::vector<int> depth;     ///< how many are around it: even for the skin of an island, odd for
                              ///< the wall of a cavity
};

/// Finds the nesting by the parity of a ray's crossings; rays that meet edges
/// and points are counted correctly.
/// @param surface     closed, without self-intersections.
/// @param components  of the surface.
Nesting find_nesting(const TriMesh& surface, const SurfaceComponents& components);

}  // namespace mesamis
