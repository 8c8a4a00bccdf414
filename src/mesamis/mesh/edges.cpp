// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/edges.h"

#include <algorithm>

namespace mesamis::detail::mesh {

std::vector<Edge> unique_edges(const TetMesh& mesh) {
  // Edges are bucketed by their smaller point: sorting short lists beats sorting one long one.
  std::vector<std::int64_t> start(mesh.points.size() + 1, 0);
  auto for_each_edge = [&mesh](auto&& visit) {
    for (const Cell& cell : mesh.cells) {
      for (const auto& [i, j] : kCellEdges) {
        visit(std::min(cell[i], cell[j]), std::max(cell[i], cell[j]));
      }
    }
  };
  for_each_edge([&](Index a, Index) { ++start[static_cast<std::size_t>(a) + 1]; });
  for (std::size_t i = 0; i < mesh.points.size(); ++i) start[i + 1] += start[i];
  std::vector<Index> partners(6 * mesh.cells.size());
  std::vector<std::int64_t> next(start.begin(), start.end() - 1);
  for_each_edge([&](Index a, Index b) {
    partners[static_cast<std::size_t>(next[static_cast<std::size_t>(a)]++)] = b;
  });
  std::vector<Edge> edges;
  edges.reserve(mesh.cells.size() + mesh.cells.size() / 4);
  for (std::size_t a = 0; a < mesh.points.size(); ++a) {
    const auto begin = partners.begin() + start[a], end = partners.begin() + start[a + 1];
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    for (auto it = begin; it != last; ++it) edges.push_back({static_cast<Index>(a), *it});
  }
  return edges;
}

}  // namespace mesamis::detail::mesh
