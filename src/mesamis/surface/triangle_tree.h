// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/box_tree.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

using Corners = std::array<Vec3, 3>;

/// The corners of a triangle of a surface, mm.
inline Corners corners_of(const TriMesh& surface, const Triangle& t) {
  return {surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]};
}

/// The unit normal of a triangle; zero where it has no area.
inline Vec3 unit_normal(const Corners& t) { return unit_or_zero(cross(t[1] - t[0], t[2] - t[0])); }

/// Squared distance from p to the triangle.
double squared_distance(const Vec3& p, const Corners& triangle);

/// The barycentric coordinates of the place of a triangle that is nearest to p.
/// @param triangle  with an area.
std::array<double, 3> nearest_place(const Vec3& p, const Corners& triangle);

/// A bounding volume hierarchy over triangles; finds the nearest one to a point.
class TriangleTree {
 public:
  /// @param surface  sound, at least one triangle.
  explicit TriangleTree(const TriMesh& surface);
  /// @param triangles  at least one; their places in the vector are their indices.
  explicit TriangleTree(std::vector<Corners> triangles);

  /// Squared distance from p to the nearest triangle.
  /// @param hint  where the last search ended; start with 0. It speeds the search up when the last
  ///              point was near, and never changes the answer beyond round-off.
  double squared_distance_to(const Vec3& p, std::size_t& hint) const;

  /// Calls visit(hint) for the triangles of leaves whose boxes overlap the given one, among them all
  /// whose own boxes do.
  template <class Visit>
  void for_each_overlap(const Box& box, Visit&& visit) const {
    std::array<std::size_t, 64> stack;  // halved at each step: depth at most 32
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const std::size_t n = stack[--size];
      const Node& node = nodes_[n];
      if (!overlap(node.box, box)) continue;
      const auto first = static_cast<std::size_t>(node.first);
      if (node.count == 0) {
        stack[size++] = first;
        stack[size++] = n + 1;
      }
      for (std::size_t i = 0; i < static_cast<std::size_t>(node.count); ++i) visit(first + i);
    }
  }

  /// The triangle a search ended at.
  const Corners& triangle(std::size_t hint) const { return triangles_[hint]; }
  /// Its index in the surface.
  Index index_of(std::size_t hint) const { return order_[hint]; }

 private:
  struct Node {
    Box box;
    Index first;  // leaf: its first triangle; else: its second child (the first comes next)
    Index count;  // leaf: its triangles; else 0
  };

  void build(std::span<PlacedItem> items, std::size_t first, std::size_t place);
  static std::size_t nodes_over(std::size_t triangles);
  double squared_distance_to_box(const Vec3& p, std::size_t node) const;

  std::vector<Node> nodes_;
  std::vector<Corners> triangles_;  // in the order of the leaves
  std::vector<Index> order_;        // of the triangles there
};

}  // namespace mesamis::detail::surface
