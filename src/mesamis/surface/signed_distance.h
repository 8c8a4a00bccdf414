// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mesamis/surface/tri_mesh.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::surface {

/// The point of a surface that is nearest to another.
struct NearestPoint {
  Vec3 point;            ///< mm
  double distance = 0;   ///< mm, >= 0
  double signed_to = 0;  ///< mm: the distance, negative where the point asked for lies inside
  Index triangle = 0;    ///< one that holds the point
  Vec3 normal;           ///< outward, of length 1: of the triangle, edge or corner that is nearest
};

/// Distances with a sign from a closed surface.
///
/// The sign is that of the pseudonormal of the nearest triangle, edge or corner, weighted by
/// angles. Source: Baerentzen and Aanaes, Signed distance computation using the angle weighted
/// pseudonormal, 2005.
class SignedDistance {
 public:
  /// @param surface  closed, 2-manifold, oriented outward, without self-intersections for the sign
  ///                 to be right; at least one triangle, mm. Is copied.
  /// @throws InputError  as require_sound(), or without a triangle.
  ///
  /// O(n log n) for n triangles.
  explicit SignedDistance(const TriMesh& surface);

  /// @param p  mm, finite.
  /// @return the same bits whoever asks, in whatever order.
  ///
  /// O(log n) for points near the surface.
  NearestPoint at(const Vec3& p) const;

 private:
  Vec3 pseudonormal(Index triangle, int feature) const;
  std::size_t hint_at(const Vec3& p) const;
  void fill_hints();
  void compute_normals();

  TriMesh surface_;
  TriangleTree tree_;
  std::vector<Vec3> face_normals_, point_normals_;
  std::vector<std::array<Vec3, 3>> edge_normals_;  // of the edges from corner i to i + 1
  // A triangle near the middle of each brick of a coarse grid, where searches start.
  Box box_;
  std::array<Index, 3> bricks_{1, 1, 1};
  std::vector<std::size_t> hints_;
};

}  // namespace mesamis::detail::surface
