// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/nesting.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::surface {
namespace {

/// Whether the ray's foot lies left of the edge from a to b, seen along x. Symbolic perturbation: a
/// foot on the edge counts as moved by an infinitesimal step in y, and an even smaller one in z, so
/// that a ray through an edge or a point crosses the triangles that a ray beside it crosses. Both
/// triangles of an edge start from the same point, whatever its numbers in them, and get the same
/// result.
bool is_left(const TriMesh& surface, Index a, Index b, const Vec3& foot) {
  Vec3 p = surface.points[a], q = surface.points[b];
  const bool swapped = std::tie(p.x, p.y, p.z) > std::tie(q.x, q.y, q.z);
  if (swapped) std::swap(p, q);
  double turn = (q.y - p.y) * (foot.z - p.z) - (q.z - p.z) * (foot.y - p.y);
  if (turn == 0) turn = p.z - q.z;
  if (turn == 0) turn = q.y - p.y;
  return (turn > 0) != swapped;
}

/// Does the ray from `foot` towards -x cross the triangle?
bool crosses(const TriMesh& surface, const Triangle& t, const Vec3& foot) {
  const bool left = is_left(surface, t[0], t[1], foot);
  if (is_left(surface, t[1], t[2], foot) != left || is_left(surface, t[2], t[0], foot) != left) {
    return false;
  }
  const Vec3& a = surface.points[t[0]];
  const Vec3 normal = cross(surface.points[t[1]] - a, surface.points[t[2]] - a);
  if (normal.x == 0) return false;
  return a.x - (normal.y * (foot.y - a.y) + normal.z * (foot.z - a.z)) / normal.x < foot.x;
}

/// Points in bins by y and z.
class Feet {
 public:
  explicit Feet(std::span<const Vec3> feet)
      : box_(bounding_box(feet)),
        side_(std::clamp<Index>(static_cast<Index>(std::sqrt(static_cast<double>(feet.size()))), 1,
                                1000)),
        bins_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)) {
    for (std::size_t c = 0; c < feet.size(); ++c) {
      bins_[bin(column(feet[c].y, 1), column(feet[c].z, 2))].push_back(static_cast<Index>(c));
    }
  }

  /// Calls visit(component) for each whose foot may lie below the triangle.
  template <class Visit>
  void for_each_near(const TriMesh& surface, const Triangle& t, Visit visit) const {
    const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    const auto [y_lo, y_hi] = std::minmax({a.y, b.y, c.y});
    const auto [z_lo, z_hi] = std::minmax({a.z, b.z, c.z});
    for (Index k = column(z_lo, 2); k <= column(z_hi, 2); ++k) {
      for (Index j = column(y_lo, 1); j <= column(y_hi, 1); ++j) {
        for (const Index component : bins_[bin(j, k)]) visit(component);
      }
    }
  }

 private:
  Index column(double x, int axis) const {
    const double extent = box_.hi[axis] - box_.lo[axis];
    if (!(extent > 0)) return 0;
    return std::clamp<Index>(static_cast<Index>((x - box_.lo[axis]) / extent * side_), 0,
                             side_ - 1);
  }
  std::size_t bin(Index j, Index k) const {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(side_) +
           static_cast<std::size_t>(j);
  }

  Box box_;
  Index side_;
  std::vector<std::vector<Index>> bins_;
};

}  // namespace

std::vector<Vec3> component_feet(const TriMesh& surface, const SurfaceComponents& components) {
  std::vector<Vec3> feet(components.sizes.size());
  std::vector<char> known(feet.size(), 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Index c = components.of_triangle[t];
    if (c == kNoIndex || known[c]) continue;
    known[c] = 1;
    feet[c] = surface.points[surface.triangles[t][0]];
  }
  return feet;
}

RayCrossings ray_crossings(std::span<const Vec3> feet, const TriMesh& piece,
                           std::span<const Index> component_of) {
  RayCrossings crossings(feet.size());
  if (feet.empty()) return crossings;
  const Feet bins(feet);
  for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
    const Index crossed = component_of[t];
    if (crossed == kNoIndex) continue;
    bins.for_each_near(piece, piece.triangles[t], [&](Index c) {
      if (c != crossed && crosses(piece, piece.triangles[t], feet[c])) ++crossings[c][crossed];
    });
  }
  return crossings;
}

Nesting nesting_of(RayCrossings crossings) {
  const std::size_t n = crossings.size();
  Nesting nesting{std::vector<Index>(n, kNoIndex), std::vector<int>(n, 0)};
  for (std::size_t c = 0; c < n; ++c) {
    std::erase_if(crossings[c], [](const auto& entry) { return entry.second % 2 == 0; });
    nesting.depth[c] = static_cast<int>(crossings[c].size());
  }
  for (std::size_t c = 0; c < n; ++c) {
    for (const auto& [around, count] : crossings[c]) {
      if (nesting.depth[around] + 1 == nesting.depth[c]) nesting.parent[c] = around;
    }
  }
  return nesting;
}

Nesting find_nesting(const TriMesh& surface, const SurfaceComponents& components) {
  return nesting_of(
      ray_crossings(component_feet(surface, components), surface, components.of_triangle));
}

}  // namespace mesamis::detail::surface
