// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/half_edges.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::surface {

std::vector<HalfEdge> sorted_half_edges(std::span<const Triangle> triangles,
                                        std::size_t point_count) {
  // Half-edges are bucketed by their smaller point: sorting short lists beats sorting one long one.
  std::vector<std::size_t> start(point_count + 1, 0);
  auto for_each_half_edge = [&triangles](auto&& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Triangle& k = triangles[t];
      if (is_degenerate(k)) continue;
      for (int i = 0; i < 3; ++i) {
        const Index a = k[static_cast<std::size_t>(i)];
        const Index b = k[static_cast<std::size_t>((i + 1) % 3)];
        visit(HalfEdge{std::min(a, b), std::max(a, b), static_cast<Index>(t), i, a < b});
      }
    }
  };
  for_each_half_edge([&](const HalfEdge& h) { ++start[static_cast<std::size_t>(h.lo) + 1]; });
  for (std::size_t p = 0; p < point_count; ++p) start[p + 1] += start[p];
  std::vector<HalfEdge> half_edges(start[point_count]);
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for_each_half_edge(
      [&](const HalfEdge& h) { half_edges[next[static_cast<std::size_t>(h.lo)]++] = h; });
  parallel_for(point_count, [&](std::size_t p) {
    const auto first = half_edges.begin() + static_cast<std::ptrdiff_t>(start[p]);
    const auto last = half_edges.begin() + static_cast<std::ptrdiff_t>(start[p + 1]);
    std::sort(first, last, [](const HalfEdge& a, const HalfEdge& b) {
      return std::tie(a.hi, a.triangle) < std::tie(b.hi, b.triangle);
    });
  });
  return half_edges;
}

DisjointSets connected_triangles(std::span<const HalfEdge> half_edges, std::size_t triangle_count) {
  DisjointSets parts(triangle_count);
  for_each_edge(half_edges, [&parts](std::span<const HalfEdge> edge) {
    for (const HalfEdge& h : edge.subspan(1)) {
      parts.unite(static_cast<std::size_t>(edge[0].triangle), static_cast<std::size_t>(h.triangle));
    }
  });
  return parts;
}

std::vector<char> points_of_several_fans(std::span<const Triangle> triangles,
                                         std::span<const HalfEdge> half_edges,
                                         std::size_t point_count) {
  DisjointSets fans(3 * triangles.size());
  for_each_edge(half_edges, [&fans](std::span<const HalfEdge> edge) {
    for (const HalfEdge& h : edge.subspan(1)) {
      fans.unite(edge[0].corner_at_lo(), h.corner_at_lo());
      fans.unite(edge[0].corner_at_hi(), h.corner_at_hi());
    }
  });
  std::vector<char> has_fan(point_count, 0), has_several(point_count, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (is_degenerate(triangles[t])) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      if (fans.find(3 * t + i) != 3 * t + i) continue;
      const Index p = triangles[t][i];
      (has_fan[p] == 0 ? has_fan : has_several)[p] = 1;
    }
  }
  return has_several;
}

}  // namespace mesamis::detail::surface
