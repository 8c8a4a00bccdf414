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

/// One pass from the start: collapses in the order of the quadrics while the promises of
/// decimate() hold. What is not checked for good is that originals, listed where they are nearest,
/// reach the result: a check afterwards may find a few that are too far.
/// @param held  1 for each point that must stay.
/// @return triangles over the points of the surface.
std::vector<Triangle> decimate_pass(const DecimateTask& task, const std::vector<char>& held);

}  // namespace mesamis
