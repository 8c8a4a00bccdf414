// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// Whether a point index occurs twice.
inline bool is_degenerate(const Triangle& t) noexcept {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// A triangle's part of the edge {lo, hi}, lo < hi.
struct HalfEdge {
  Index lo, hi;  ///< points
  Index triangle;
  int corner;    ///< 0 to 2: runs from this corner of the triangle to the next
  bool forward;  ///< runs from lo to hi

  /// Where it meets lo and hi; corners of all triangles are numbered 3 t + i.
  std::size_t corner_at_lo() const { return global(forward ? corner : (corner + 1) % 3); }
  std::size_t corner_at_hi() const { return global(forward ? (corner + 1) % 3 : corner); }

 private:
  std::size_t global(int i) const {
    return 3 * static_cast<std::size_t>(triangle) + static_cast<std::size_t>(i);
  }
};

/// Lists the half-edges of all triangles that are not degenerate, edge by edge.
///
/// @param triangles    indices in [0, point_count).
/// @return in the order of lo, hi and triangle.
///
/// O(m log d) for m triangles and at most d edges at a point; 20 bytes per half-edge.
std::vector<HalfEdge> sorted_half_edges(std::span<const Triangle> triangles,
                                        std::size_t point_count);

/// Calls visit(std::span<const HalfEdge>) once per edge.
/// @param half_edges  of sorted_half_edges().
template <class Visit>
void for_each_edge(std::span<const HalfEdge> half_edges, Visit&& visit) {
  for (std::size_t begin = 0; begin < half_edges.size();) {
    const HalfEdge& first = half_edges[begin];
    std::size_t end = begin + 1;
    while (end < half_edges.size() && half_edges[end].lo == first.lo &&
           half_edges[end].hi == first.hi) {
      ++end;
    }
    visit(half_edges.subspan(begin, end - begin));
    begin = end;
  }
}

/// Unites the triangles that share an edge, however many share it. O(n log n).
/// @param half_edges  of sorted_half_edges().
DisjointSets connected_triangles(std::span<const HalfEdge> half_edges, std::size_t triangle_count);

/// Marks the points where the triangles make several fans: one cannot walk from each to each across
/// edges at the point. Degenerate triangles are left out. O(n log n).
/// @param half_edges  sorted_half_edges() of the triangles.
/// @return 1 or 0 for each point.
std::vector<char> points_of_several_fans(std::span<const Triangle> triangles,
                                         std::span<const HalfEdge> half_edges,
                                         std::size_t point_count);

}  // namespace mesamis::detail::surface
