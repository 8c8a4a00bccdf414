// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "mesamis/decimate/interfaces.h"
#include "mesamis/decimate/patch.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis {

/// The input that all passes of decimate() share.
struct DecimateTask {
  const TriMesh& surface;               ///< the original: a 2-manifold, closed or a part
  std::span<const TriangleTree> trees;  ///< of the original; of each of its interfaces, if any
  double tolerance;                     ///< mm; infinity: none
  std::int64_t triangles;               ///< a pass stops at so many
  std::function<void(double)> progress;
  bool quick = false;  ///< only the drift proves that triangles are near; what they stand for is
                       ///< not kept
  /// Of the surface, if it is a partition's; nullptr: none.
  const Interfaces* interfaces = nullptr;

  /// The interface of a point of the surface; 0 if there are none.
  Index interface_at(Index point) const { return interfaces ? interfaces->of_point[point] : 0; }
  /// The tree of what a point of the surface must stay near.
  const TriangleTree& tree_at(Index point) const {
    return trees[static_cast<std::size_t>(interface_at(point))];
  }
  /// Of points that are copies of one, the first.
  Index first_copy(Index point) const { return interfaces ? interfaces->first_copy[point] : point; }
};

/// Makes one pass over a patch: collapses in the order of the quadrics while the guarantees of
/// decimate() hold. One of them is only tested locally: the distance of original triangles to the
/// result. A check afterwards may find a few that are too far.
/// @return over the points of the patch.
Cover decimate_pass(const DecimateTask& task, const Patch& patch);

}  // namespace mesamis
