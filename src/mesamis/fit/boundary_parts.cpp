// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/boundary_parts.h"

#include <algorithm>

#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::fit {
namespace {

/// Which sides of triangles, 2 t behind triangle t and 2 t + 1 in front of it, bound the same part:
/// those that share a point and have the same material.
DisjointSets connected_sides(const TriMesh& surface, Sides sides) {
  struct Seen {
    Index material = 0;
    std::size_t side = 0, next = 0;
  };
  constexpr std::size_t kNone = 0;
  std::vector<Seen> seen(1);  // at each point a list of the materials, the first of its sides each
  std::vector<std::size_t> first(surface.points.size(), kNone);
  DisjointSets sets(2 * sides.size());
  for (std::size_t s = 0; s < 2 * sides.size(); ++s) {
    const Index material = sides[s / 2][s % 2];
    if (material <= 0) continue;
    for (const Index p : surface.triangles[s / 2]) {
      std::size_t at = first[p];
      while (at != kNone && seen[at].material != material) at = seen[at].next;
      if (at != kNone) {
        sets.unite(seen[at].side, s);
      } else {
        seen.push_back({material, s, first[p]});
        first[p] = seen.size() - 1;
      }
    }
  }
  return sets;
}

}  // namespace

std::size_t material_count(Sides sides) {
  Index last = 0;
  for (const auto& pair : sides) last = std::max({last, pair[0], pair[1]});
  return static_cast<std::size_t>(last) + 1;
}

std::vector<double> enclosed_volumes(const TriMesh& surface, Sides sides) {
  return sums_of_materials(sides, -1, [&](std::size_t t) {
    const auto [a, b, c] = corners_of(surface, surface.triangles[t]);
    return dot(a, cross(b, c)) / 6;
  });
}

void BoundaryParts::scale_to(std::span<const double> of_materials) {
  std::vector<double> sum(of_materials.size(), 0);
  for (std::size_t p = 1; p < material.size(); ++p) {
    if (material[p] < std::ssize(sum)) sum[material[p]] += volumes[p];
  }
  for (std::size_t p = 1; p < material.size(); ++p) {
    const Index m = material[p];
    if (m < std::ssize(sum) && sum[m] > 0) volumes[p] *= of_materials[m] / sum[m];
  }
}

BoundaryParts parts_of_boundaries(const TriMesh& surface, Sides sides) {
  DisjointSets sets = connected_sides(surface, sides);
  BoundaryParts parts{{sides.begin(), sides.end()}, {0}, {}};
  std::vector<Index> number(2 * sides.size(), kNoIndex);
  for (std::size_t s = 0; s < number.size(); ++s) {
    Index& side = parts.sides[s / 2][s % 2];
    if (side <= 0) continue;
    Index& part = number[sets.find(s)];
    if (part == kNoIndex) {
      part = static_cast<Index>(parts.material.size());
      parts.material.push_back(side);
    }
    side = part;
  }
  parts.volumes = enclosed_volumes(surface, parts.sides);
  parts.volumes.resize(parts.material.size(), 0);
  return parts;
}

}  // namespace mesamis::detail::fit
