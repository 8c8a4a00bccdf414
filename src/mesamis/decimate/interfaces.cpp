// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/interfaces.h"

#include <algorithm>
#include <string>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/surface/half_edges.h"

namespace mesamis::detail::decimate {
namespace {

void require_sides(const PartitionSurface& partition) {
  require_sound({partition.points, partition.triangles});
  const auto flat =
      std::find_if(partition.triangles.begin(), partition.triangles.end(), is_degenerate);
  if (flat != partition.triangles.end()) {
    throw InputError("partition: triangle " + std::to_string(flat - partition.triangles.begin()) +
                     " has a repeated corner");
  }
  if (partition.sides.size() == partition.triangles.size()) return;
  throw InputError("partition: expected a pair of sides for each of " +
                   std::to_string(partition.triangles.size()) + " triangles, found " +
                   std::to_string(partition.sides.size()));
}

/// The corners of all triangles, numbered 3 t + i. Those of triangles that share an edge between
/// two are one point.
class CornerPoints {
 public:
  explicit CornerPoints(const PartitionSurface& partition)
      : partition_(partition),
        sets_(3 * partition.triangles.size()),
        at_rim_(3 * partition.triangles.size(), 0) {
    const auto half_edges = sorted_half_edges(partition.triangles, partition.points.size());
    for_each_edge(half_edges, [this](std::span<const HalfEdge> edge) { visit(edge); });
  }

  Interfaces interfaces() {
    Interfaces interfaces;
    const std::vector<std::size_t> firsts = first_corners();
    std::vector<Index> number(at_rim_.size(), kNoIndex);
    for (const std::size_t corner : firsts) {
      number[corner] = static_cast<Index>(interfaces.origin.size());
      interfaces.origin.push_back(point_at(corner));
      interfaces.surface.points.push_back(partition_.points[point_at(corner)]);
    }
    interfaces.at_rim.assign(interfaces.origin.size(), 0);
    for (std::size_t t = 0; t < partition_.triangles.size(); ++t) {
      Triangle& triangle = interfaces.surface.triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        triangle[i] = number[sets_.find(3 * t + i)];
        interfaces.at_rim[triangle[i]] |= at_rim_[3 * t + i];
      }
    }
    return interfaces;
  }

 private:
  Index point_at(std::size_t corner) const { return partition_.triangles[corner / 3][corner % 3]; }

  void visit(std::span<const HalfEdge> edge) {
    const bool is_inner = edge.size() == 2;
    for (const HalfEdge& half : edge) {
      at_rim_[half.corner_at_lo()] |= is_inner ? 0 : 1;
      at_rim_[half.corner_at_hi()] |= is_inner ? 0 : 1;
    }
    if (!is_inner) return;
    require_same_sides(edge[0].triangle, edge[1].triangle);
    sets_.unite(edge[0].corner_at_lo(), edge[1].corner_at_lo());
    sets_.unite(edge[0].corner_at_hi(), edge[1].corner_at_hi());
  }

  void require_same_sides(Index a, Index b) const {
    if (partition_.sides[a] == partition_.sides[b]) return;
    throw InputError("partition: triangles " + std::to_string(a) + " and " + std::to_string(b) +
                     " alone share an edge, but their sides differ");
  }

  /// One corner for each point of an interface, in the order of the partition's points.
  std::vector<std::size_t> first_corners() {
    std::vector<std::size_t> firsts;
    for (std::size_t corner = 0; corner < at_rim_.size(); ++corner) {
      if (sets_.find(corner) == corner) firsts.push_back(corner);
    }
    std::stable_sort(firsts.begin(), firsts.end(),
                     [this](std::size_t a, std::size_t b) { return point_at(a) < point_at(b); });
    return firsts;
  }

  const PartitionSurface& partition_;
  DisjointSets sets_;
  std::vector<char> at_rim_;
};

void find_copies(Interfaces& interfaces) {
  for (Index p = 0; p < std::ssize(interfaces.origin); ++p) {
    const bool is_copy = p > 0 && interfaces.origin[p] == interfaces.origin[p - 1];
    interfaces.first_copy.push_back(is_copy ? interfaces.first_copy.back() : p);
    if (is_copy) interfaces.at_rim[p] = interfaces.at_rim[p - 1] = 1;
  }
}

/// The two neighbours of each point along the rim that it is on; kNoIndex: it is on none.
std::vector<std::array<Index, 2>> neighbors_along_rims(const TriMesh& surface) {
  std::vector<std::array<Index, 2>> along(surface.points.size(), {kNoIndex, kNoIndex});
  const auto half_edges = sorted_half_edges(surface.triangles, surface.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 1) return;
    for (const auto& [p, q] : {std::pair{edge[0].lo, edge[0].hi}, {edge[0].hi, edge[0].lo}}) {
      along[p][along[p][0] == kNoIndex ? 0 : 1] = q;
    }
  });
  return along;
}

void find_kinds_of_points(Interfaces& interfaces) {
  std::vector<std::array<Index, 2>> along = neighbors_along_rims(interfaces.surface);
  for (std::array<Index, 2>& ends : along) {
    for (Index& q : ends) q = q == kNoIndex ? q : interfaces.first_copy[q];
    std::sort(ends.begin(), ends.end());
  }
  interfaces.within_curve.assign(along.size(), 0);
  interfaces.touches_itself.assign(along.size(), 0);
  const auto end = static_cast<Index>(along.size());
  for (Index first = 0, last = 0; first < end; first = last) {
    std::vector<Index> own;
    bool same = along[first][0] != kNoIndex && along[first][0] != along[first][1];
    for (last = first; last < end && interfaces.first_copy[last] == first; ++last) {
      same &= along[last] == along[first];
      add_once(own, interfaces.of_point[last]);
    }
    const bool touches_itself = std::ssize(own) < last - first;
    const bool is_within = same && last - first >= 3 && !touches_itself;
    for (Index p = first; p < last; ++p) {
      interfaces.within_curve[p] = is_within ? 1 : 0;
      interfaces.touches_itself[p] = touches_itself ? 1 : 0;
    }
  }
}

void number_interfaces(Interfaces& interfaces) {
  DisjointSets sets(interfaces.origin.size());
  for (const Triangle& t : interfaces.surface.triangles) {
    sets.unite(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]));
    sets.unite(static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2]));
  }
  DisjointSets::Numbers numbers = sets.numbers();
  interfaces.of_point = std::move(numbers.of_item);
  interfaces.count = numbers.count;
}

void require_manifold(const TriMesh& interfaces) {
  const SurfaceCheck check = check_surface(interfaces);
  if (check.manifold()) return;
  throw InputError("partition: expected interfaces that are 2-manifolds with rims, found " +
                   flaws_of(check));
}

}  // namespace

Interfaces cut_into_interfaces(const PartitionSurface& partition) {
  require_sides(partition);
  Interfaces interfaces = CornerPoints(partition).interfaces();
  require_manifold(interfaces.surface);
  find_copies(interfaces);
  number_interfaces(interfaces);
  find_kinds_of_points(interfaces);
  return interfaces;
}

std::vector<TriMesh> split_interfaces(const Interfaces& interfaces,
                                      const std::vector<Triangle>& triangles) {
  std::vector<TriMesh> split(static_cast<std::size_t>(interfaces.count));
  std::vector<Index> place(interfaces.origin.size());  // in its interface
  for (std::size_t p = 0; p < place.size(); ++p) {
    std::vector<Vec3>& points = split[interfaces.of_point[p]].points;
    place[p] = static_cast<Index>(points.size());
    points.push_back(interfaces.surface.points[p]);
  }
  for (const Triangle& t : triangles) {
    split[interfaces.of_point[t[0]]].triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  }
  return split;
}

}  // namespace mesamis::detail::decimate
