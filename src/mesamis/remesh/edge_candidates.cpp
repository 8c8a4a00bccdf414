// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/edge_candidates.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "mesamis/remesh/geometry.h"

namespace mesamis::detail::remesh {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

float squared_length_single(const MetricFactor& l, const std::array<float, 3>& e) {
  const float x = l.xx * e[0] + l.yx * e[1] + l.zx * e[2], y = l.yy * e[1] + l.zy * e[2],
              z = l.zz * e[2];
  return x * x + y * y + z * z;
}

/// Whether the edge is within both bounds in both its metrics, and not only by rounding; single
/// precision and no roots are enough for that.
bool is_between(const Vertex& a, const Vertex& b, float square_min, float square_max) {
  const Vec3 d = b.position - a.position;
  const std::array<float, 3> e{static_cast<float>(d.x), static_cast<float>(d.y),
                               static_cast<float>(d.z)};
  const float la2 = squared_length_single(a.metric, e), lb2 = squared_length_single(b.metric, e);
  return la2 >= square_min && lb2 >= square_min && la2 <= square_max && lb2 <= square_max;
}

/// Edges outside the bounds. Each edge comes once per cell around it; sorting brings the copies
/// together.
std::vector<EdgeCandidate> gather(WorkingMesh& mesh, std::uint8_t operation, double length_min,
                                  double length_max) {
  constexpr double kRounding = 1e-5;
  const auto square_min = static_cast<float>((1 + kRounding) * length_min * length_min);
  const auto square_max = static_cast<float>((1 - kRounding) * length_max * length_max);
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

}  // namespace mesamis::detail::remesh
