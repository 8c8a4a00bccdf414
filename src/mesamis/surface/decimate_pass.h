// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "mesamis/surface/tri_mesh.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis {

/// What the passes of decimate() share.
struct DecimateTask {
  const TriMesh& surface;    ///< closed, 2-manifold
  const TriangleTree& tree;  ///< of the surface
  double tolerance;          ///< mm, infinity: none
  std::int64_t triangles;    ///< to stop at
  std::function<void(double)> progress;
};

/// One pass from the start: collapses while quadrics, samples and neighbours allow it. Distances
/// are checked at samples only; the rest of the promises of decimate() hold.
/// @param held  1 for each point that must stay.
/// @return triangles over the points of the surface.
std::vector<Triangle> decimate_pass(const DecimateTask& task, const std::vector<char>& held);

}  // namespace mesamis
