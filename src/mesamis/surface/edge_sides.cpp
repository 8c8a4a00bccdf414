// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/edge_sides.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "mesamis/base/parallel.h"

namespace mesamis {

std::vector<EdgeSide> sorted_edge_sides(std::span<const Triangle> triangles,
                                        std::size_t point_count) {
  // Sides are bucketed by their smaller point: sorting short lists beats sorting one long one.
  std::vector<std::size_t> start(point_count + 1, 0);
  auto for_each_side = [&triangles](auto&& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Triangle& k = triangles[t];
      if (is_degenerate(k)) continue;
      for (int i = 0; i < 3; ++i) {
        const Index a = k[static_cast<std::size_t>(i)];
        const Index b = k[static_cast<std::size_t>((i + 1) % 3)];
        visit(EdgeSide{std::min(a, b), std::max(a, b), static_cast<Index>(t), i, a < b});
      }
    }
  };
  for_each_side([&](const EdgeSide& s) { ++start[static_cast<std::size_t>(s.lo) + 1]; });
  for (std::size_t p = 0; p < point_count; ++p) start[p + 1] += start[p];
  std::vector<EdgeSide> sides(start[point_count]);
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for_each_side([&](const EdgeSide& s) { sides[next[static_cast<std::size_t>(s.lo)]++] = s; });
  parallel_for(point_count, [&](std::size_t p) {
    const auto first = sides.begin() + static_cast<std::ptrdiff_t>(start[p]);
    const auto last = sides.begin() + static_cast<std::ptrdiff_t>(start[p + 1]);
    std::sort(first, last, [](const EdgeSide& a, const EdgeSide& b) {
      return std::tie(a.hi, a.triangle) < std::tie(b.hi, b.triangle);
    });
  });
  return sides;
}

DisjointSets connected_triangles(std::span<const EdgeSide> sides, std::size_t triangle_count) {
  DisjointSets parts(triangle_count);
  for_each_edge(sides, [&parts](std::span<const EdgeSide> edge) {
    for (const EdgeSide& side : edge.subspan(1)) {
      parts.unite(static_cast<std::size_t>(edge[0].triangle),
                  static_cast<std::size_t>(side.triangle));
    }
  });
  return parts;
}

}  // namespace mesamis
