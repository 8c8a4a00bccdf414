// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/edge_candidates.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "mesamis/remesh/geometry.h"

namespace mesamis::remeshing {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Whether the edge is within both bounds in both its metrics; no roots are needed.
bool is_between(const Vertex& a, const Vertex& b, double square_min, double square_max) {
  const Vec3 e = b.position - a.position;
  const double la2 = squared_length(a.metric, e), lb2 = squared_length(b.metric, e);
  return la2 >= square_min && lb2 >= square_min && la2 <= square_max && lb2 <= square_max;
}

/// Edges outside the bounds. Each edge comes once per cell around it; sorting brings the copies
/// together.
std::vector<EdgeCandidate> gather(WorkingMesh& mesh, std::uint8_t operation, double length_min,
                                  double length_max) {
  const double square_min = length_min * length_min, square_max = length_max * length_max;
  std::vector<EdgeCandidate> edges;
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) {
    if (!take_pending(mesh, c, operation)) continue;
    const Cell& points = mesh.cells[c].points;
    for (const auto& [i, j] : kCellEdges) {
      const auto [a, b] = std::minmax(points[i], points[j]);
      const Vertex &va = mesh.vertices[a], &vb = mesh.vertices[b];
      if (is_between(va, vb, square_min, square_max)) continue;
      const double l = length(va, vb);
      if (l < length_min || l > length_max) edges.push_back({static_cast<float>(l), a, b, c});
    }
  }
  return edges;
}

}  // namespace

std::vector<EdgeCandidate> long_edges(WorkingMesh& mesh, double limit) {
  auto edges = gather(mesh, kToSplit, 0, limit);
  std::sort(edges.begin(), edges.end(), [](const EdgeCandidate& x, const EdgeCandidate& y) {
    return std::tie(y.length, x.a, x.b, x.cell) < std::tie(x.length, y.a, y.b, y.cell);
  });
  return edges;
}

std::vector<EdgeCandidate> short_edges(WorkingMesh& mesh, double limit) {
  auto edges = gather(mesh, kToCollapse, limit, kNoLimit);
  std::sort(edges.begin(), edges.end(), [](const EdgeCandidate& x, const EdgeCandidate& y) {
    return std::tie(x.length, x.a, x.b, x.cell) < std::tie(y.length, y.a, y.b, y.cell);
  });
  return edges;
}

}  // namespace mesamis::remeshing
