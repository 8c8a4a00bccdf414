// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/split_bends.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/fit/surface_moves.h"
#include "mesamis/surface/measure.h"
#include "mesamis/surface/normals.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::fit {
namespace {

const double kCosineOfBend = std::cos(15 * std::numbers::pi / 180);
constexpr double kMostHeight = 0.25;  // of an edge's length

/// The edges of a surface, at their ends' places in Neighbors: at the lower end's.
class BentEdges {
 public:
  /// @param no_normal  of each point 1 where the surface has none; edges between two such stay.
  /// @param whole      the same for another reason; empty: none.
  BentEdges(const TriMesh& surface, const std::vector<char>& no_normal, std::span<const char> whole)
      : surface_(surface), neighbors_(surface), middle_(neighbors_.points.size(), kNoIndex) {
    std::vector<Beside> at(middle_.size());
    for (Index t = 0; t < std::ssize(surface.triangles); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        auto& [count, some, other] = at[edge_of(surface.triangles[t], i)];
        (count == 0 ? some : other) = t;
        ++count;
      }
    }
    std::vector<char> bent(at.size(), 0);
    parallel_for(surface.points.size(), [&](std::size_t p) {
      for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
        const Index q = neighbors_.points[n];
        if (at[n].count != 2 || no_normal[p] + no_normal[q] == 2) continue;
        if (!whole.empty() && whole[p] + whole[q] == 2) continue;
        bent[n] = is_bent(at[n].some, at[n].other) ? 1 : 0;
      }
    });
    for (std::size_t p = 0; p < surface.points.size(); ++p) {
      for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
        if (bent[n] == 0) continue;
        middle_[n] = static_cast<Index>(surface.points.size() + edges_.size());
        edges_.push_back({static_cast<Index>(p), neighbors_.points[n]});
      }
    }
  }

  /// The ends of the edges that are split.
  const std::vector<std::array<Index, 2>>& edges() const { return edges_; }
  /// The new point amid the edge from corner i of a triangle to the next; kNoIndex: none.
  Index middle(const Triangle& t, std::size_t i) const { return middle_[edge_of(t, i)]; }

 private:
  struct Beside {
    int count = 0;
    Index some = kNoIndex, other = kNoIndex;
  };

  std::size_t edge_of(const Triangle& t, std::size_t i) const {
    const Index a = t[i], b = t[(i + 1) % 3];
    return neighbors_.place_of(std::max(a, b), std::min(a, b));
  }

  bool is_bent(Index some, Index other) const {
    const Vec3 a = normal_of(some), b = normal_of(other);
    return dot(a, b) < kCosineOfBend * norm(a) * norm(b);
  }

  Vec3 normal_of(Index t) const {
    const auto [a, b, c] = corners_of(surface_, surface_.triangles[t]);
    return cross(b - a, c - a);
  }

  const TriMesh& surface_;
  Neighbors neighbors_;
  std::vector<Index> middle_;
  std::vector<std::array<Index, 2>> edges_;
};

/// From amid an edge to the curve over it.
Vec3 height_over(const std::array<Index, 2>& edge, const TriMesh& surface,
                 const std::vector<Vec3>& normals, const std::vector<char>& no_normal) {
  const auto [a, b] = edge;
  const Vec3 along = surface.points[b] - surface.points[a];
  const Vec3 at_a = dot(along, normals[a]) * normals[a];
  const Vec3 at_b = dot(along, normals[b]) * normals[b];
  Vec3 height = 0.125 * (at_b - at_a);
  if (no_normal[a] != 0) height = 0.25 * at_b;
  if (no_normal[b] != 0) height = -0.25 * at_a;
  const double length = norm(height), most = kMostHeight * norm(along);
  return (length > most ? most / length : 1) * height;
}

/// The parts of a triangle.
/// @param m  the new points amid its edges, or kNoIndex.
void add_parts(Triangle t, std::array<Index, 3> m, const TriMesh& surface,
               std::vector<Triangle>& out) {
  const auto count = 3 - std::count(m.begin(), m.end(), kNoIndex);
  const auto turn = [&] {
    std::rotate(t.begin(), t.begin() + 1, t.end());
    std::rotate(m.begin(), m.begin() + 1, m.end());
  };
  if (count == 0) {
    out.push_back(t);
  } else if (count == 1) {
    while (m[0] == kNoIndex) turn();
    out.push_back({t[0], m[0], t[2]});
    out.push_back({m[0], t[1], t[2]});
  } else if (count == 2) {
    while (m[2] != kNoIndex) turn();
    out.push_back({m[0], t[1], m[1]});
    // A quadrilateral t0 m0 m1 t2 is left.
    const auto length = [&](Index a, Index b) {
      return norm(surface.points[a] - surface.points[b]);
    };
    if (length(t[0], m[1]) <= length(m[0], t[2])) {
      out.push_back({t[0], m[0], m[1]});
      out.push_back({t[0], m[1], t[2]});
    } else {
      out.push_back({t[0], m[0], t[2]});
      out.push_back({m[0], m[1], t[2]});
    }
  } else {
    out.push_back({m[0], m[1], m[2]});
    for (int corner = 0; corner < 3; ++corner, turn()) out.push_back({t[0], m[0], m[2]});
  }
}

}  // namespace

SplitBoundaries split_bends(const BentBoundaries& boundaries, const VoxelGrid& grid) {
  const TriMesh& surface = boundaries.surface;
  const Sides sides = boundaries.sides;
  const SurfaceSpace space(grid, 1);
  std::vector<char> no_normal = boundaries.on_curve;
  parallel_for(no_normal.size(), [&](std::size_t p) {
    if (space.on_box(surface.points[p])) no_normal[p] = 1;
  });
  const BentEdges bent(surface, no_normal, boundaries.whole);
  const std::vector<Vec3> normals = vertex_normals(surface);
  SplitBoundaries split{
      {surface.points, {}}, {}, bent.edges(), std::vector<Vec3>(surface.points.size())};
  for (const auto& edge : split.edges) {
    split.surface.points.push_back(surface.points[edge[0]] +
                                   0.5 * (surface.points[edge[1]] - surface.points[edge[0]]));
    const Vec3 height = height_over(edge, surface, normals, no_normal);
    split.shifts.push_back(space.within_box(split.surface.points.back(), height));
  }
  for (std::size_t t = 0; t < sides.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    add_parts(triangle,
              {bent.middle(triangle, 0), bent.middle(triangle, 1), bent.middle(triangle, 2)},
              split.surface, split.surface.triangles);
    split.sides.resize(split.surface.triangles.size(), sides[t]);
  }
  return split;
}

}  // namespace mesamis::detail::fit
