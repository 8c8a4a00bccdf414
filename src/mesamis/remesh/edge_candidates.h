// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/remesh/working_mesh.h"

namespace mesamis::detail::remesh {

/// An edge that is too long or too short, and one of its cells when it was found.
struct EdgeCandidate {
  float length;
  Index a, b, cell;  ///< a < b

  /// Has an earlier operation removed the edge's cell, or the edge from it?
  bool is_gone(const WorkingMesh& mesh) const {
    const Cell& points = mesh.cells[cell].points;
    return points[0] == kNoIndex || local_index(points, a) < 0 || local_index(points, b) < 0;
  }
  bool is_same_edge(const EdgeCandidate& other) const { return a == other.a && b == other.b; }
};

/// Edges longer than `limit` of the cells that wait for kToSplit, longest first.
std::vector<EdgeCandidate> long_edges(WorkingMesh& mesh, double limit);

/// Edges shorter than `limit` of the cells that wait for kToCollapse, shortest first.
std::vector<EdgeCandidate> short_edges(WorkingMesh& mesh, double limit);

}  // namespace mesamis::detail::remesh
