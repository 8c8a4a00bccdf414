// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "mesamis/surface/tri_mesh.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis {

/// The input that all passes of decimate() share.
struct DecimateTask {
  const TriMesh& surface;    ///< closed, 2-manifold
  const TriangleTree& tree;  ///< of the surface
  double tolerance;          ///< mm; infinity: none
  std::int64_t triangles;    ///< the pass stops at so many
  std::function<void(double)> progress;
};

/// Makes one pass from the start: collapses in the order of the quadrics while the guarantees of
/// decimate() hold. One of them is only tested locally: the distance of original triangles to the
/// result. A check afterwards may find a few that are too far.
/// @param held  1 for each point that must not be removed.
/// @return triangles over the points of the surface.
std::vector<Triangle> decimate_pass(const DecimateTask& task, const std::vector<char>& held);

}  // namespace mesamis
