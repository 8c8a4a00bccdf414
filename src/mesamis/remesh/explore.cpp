// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/explore.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/remesh/geometry.h"

namespace mesamis::detail::remesh {
namespace {

constexpr int kProbesPerSide = 64;
constexpr double kProbes = 1.0 * kProbesPerSide * kProbesPerSide * kProbesPerSide;
/// A good cell holds about 1/9 unit of complexity; one that holds this much is far too large.
constexpr double kMostComplexity = 1;
constexpr double kLongEdge = 2;

std::array<Vec3, 4> corners(const WorkingMesh& mesh, Index cell) {
  const Cell& k = mesh.cells[cell].points;
  return {mesh.vertices[k[0]].position, mesh.vertices[k[1]].position, mesh.vertices[k[2]].position,
          mesh.vertices[k[3]].position};
}

double volume(const std::array<Vec3, 4>& p) { return six_volume(p[0], p[1], p[2], p[3]) / 6; }

bool has_long_edge(const WorkingMesh& mesh, const Cell& points, double length_max) {
  return std::any_of(kCellEdges.begin(), kCellEdges.end(), [&](const auto& edge) {
    return length(mesh.vertices[points[edge[0]]], mesh.vertices[points[edge[1]]]) > length_max;
  });
}

/// Calls visit(weights) for at least `count` points spread evenly over a cell.
template <class Visit>
void for_each_probe(double count, Visit visit) {
  int order = 0;
  while ((order + 1.0) * (order + 2.0) * (order + 3.0) < 6 * count) ++order;
  auto weight = [order](int i) { return (i + 0.25) / (order + 1); };
  for (int i = 0; i <= order; ++i) {
    for (int j = 0; i + j <= order; ++j) {
      for (int k = 0; i + j + k <= order; ++k) {
        visit(std::array{weight(i), weight(j), weight(k), weight(order - i - j - k)});
      }
    }
  }
}

struct ProbeResult {
  double complexity = 0;
  MetricFactor finest;
};

ProbeResult probe(const std::array<Vec3, 4>& p, const MetricSampler& sampler, double count,
                  Index hint) {
  double densities = 0, highest = -1;
  int probes = 0;
  ProbeResult result;
  for_each_probe(count, [&](const std::array<double, 4>& w) {
    const MetricFactor metric =
        sampler.at(w[0] * p[0] + w[1] * p[1] + w[2] * p[2] + w[3] * p[3], hint);
    const double d = density(metric);
    densities += d;
    ++probes;
    if (d <= highest) return;
    highest = d;
    result.finest = metric;
  });
  result.complexity = volume(p) * densities / probes;
  return result;
}

/// The cell's longest edge in the finest metric inside, or -1 when all is as it should be.
int find_unseen_edge(const WorkingMesh& mesh, const MetricSampler& sampler, Index cell) {
  const auto p = corners(mesh, cell);
  const double count = volume(p) / mesh.box.volume() * kProbes;
  const Index hint = mesh.vertices[mesh.cells[cell].points[0]].hint;
  const ProbeResult found = probe(p, sampler, count, hint);
  if (!(found.complexity > kMostComplexity)) return -1;
  int longest = -1;
  double square_max = kLongEdge * kLongEdge;
  for (int e = 0; e < 6; ++e) {
    const double square = squared_length(found.finest, p[kCellEdges[e][1]] - p[kCellEdges[e][0]]);
    if (square <= square_max) continue;
    square_max = square;
    longest = e;
  }
  return longest;
}

/// Cells large enough for a probe, not yet looked at, that no regular split is waiting for.
std::vector<Index> cells_to_probe(WorkingMesh& mesh, double length_max) {
  const double volume_min = mesh.box.volume() / kProbes;
  std::vector<Index> cells;
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) {
    if (!mesh.cells[c].alive() || !(mesh.cells[c].pending & kToExplore)) continue;
    const bool is_small = volume(corners(mesh, c)) < volume_min;
    if (!is_small && has_long_edge(mesh, mesh.cells[c].points, length_max)) continue;
    if (take_pending(mesh, c, kToExplore) && !is_small) cells.push_back(c);
  }
  return cells;
}

std::int64_t explore_once(Workbench& bench, const SplitRule& rule) {
  WorkingMesh& mesh = bench.mesh;
  const std::vector<Index> cells = cells_to_probe(mesh, rule.length_max);
  std::vector<int> edges(cells.size());
  parallel_blocks(cells.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      edges[i] = find_unseen_edge(mesh, bench.sampler, cells[i]);
    }
  });
  std::vector<Cell> points(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) points[i] = mesh.cells[cells[i]].points;
  std::int64_t splits = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    // A cell that a split of its neighbour has replaced is probed again in the next sweep.
    if (edges[i] < 0 || mesh.cells[cells[i]].points != points[i]) continue;
    if (mesh.cell_count() >= rule.most_cells) break;
    const auto& [a, b] = kCellEdges[edges[i]];
    splits += split_edge(bench, {cells[i], points[i][a], points[i][b], true}, rule);
  }
  return splits;
}

}  // namespace

std::int64_t split_unseen_detail(Workbench& bench, const SplitRule& rule) {
  constexpr int kMostSweeps = 40;
  std::int64_t splits = 0;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    const std::int64_t found = explore_once(bench, rule);
    splits += found;
    if (found == 0) break;
  }
  return splits;
}

double probe_complexity(const MetricSampler& sampler, const Box& box) {
  const Vec3 extent = box.extent();
  auto coordinate = [&](int axis, std::size_t i) {
    return box.lo[axis] + extent[axis] * (static_cast<double>(i) + 0.5) / kProbesPerSide;
  };
  constexpr auto n = static_cast<std::size_t>(kProbesPerSide);
  const double sum = parallel_sum(n * n * n, [&](std::size_t begin, std::size_t end) {
    double densities = 0;
    Index hint = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 p{coordinate(0, i % n), coordinate(1, i / n % n), coordinate(2, i / (n * n))};
      densities += density(sampler.at(p, hint));
    }
    return densities;
  });
  return sum / kProbes * box.volume();
}

}  // namespace mesamis::detail::remesh
