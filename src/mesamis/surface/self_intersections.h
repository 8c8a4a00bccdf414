// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

class BoxTree;

/// Two triangles of a surface, the smaller index first.
using TrianglePair = std::array<Index, 2>;

/// Finds the pairs of triangles that share a point of space other than a common corner or side.
///
/// A triangle without area is paired with itself. Points are distinguished by their index: two
/// points at the same place touch, and touching counts. Exact: the result does not depend on
/// rounding, see exact_predicates.h.
///
/// @param surface  n triangles.
/// @return each pair once, in ascending order.
/// @throws InputError  as require_sound().
///
/// O(n log n) for a surface that rarely meets itself.
std::vector<TrianglePair> find_self_intersections(const TriMesh& surface);

/// The triangles at chosen points: what SelfIntersections::after_move_of() takes once these have
/// moved.
/// @param chosen  of each point 1 or 0.
/// @return indices, increasing.
///
/// O(n) for n triangles.
std::vector<Index> triangles_at(std::span<const Triangle> triangles,
                                const std::vector<char>& chosen);

/// Finds self-intersections again and again while points of the surface move.
class SelfIntersections {
 public:
  /// @param surface  n triangles; read where it is, also later.
  /// @throws InputError  as require_sound().
  ///
  /// O(n log n).
  explicit SelfIntersections(const TriMesh& surface);
  ~SelfIntersections();

  /// All pairs, of the points as they were when the search was last told of them.
  /// @return as find_self_intersections().
  ///
  /// O(n log n) for a surface that rarely meets itself.
  std::vector<TrianglePair> all() const;

  /// All pairs, where any points have moved.
  /// @return as find_self_intersections().
  ///
  /// O(n log n) for a surface that rarely meets itself.
  std::vector<TrianglePair> after_move();

  /// The pairs that these triangles, whose points have moved, take part in now.
  /// @param triangles  indices, increasing.
  /// @return each pair once, in ascending order.
  ///
  /// O(log n) for each of them where the surface rarely meets itself.
  std::vector<TrianglePair> after_move_of(std::span<const Index> triangles);

 private:
  Box box_of(Index t) const;
  bool meet(std::size_t t, std::size_t other) const;
  void add_without_area(std::size_t t, std::vector<TrianglePair>& pairs) const;

  const TriMesh& surface_;
  std::unique_ptr<BoxTree> tree_;  // of the triangles
};

}  // namespace mesamis::detail::surface
