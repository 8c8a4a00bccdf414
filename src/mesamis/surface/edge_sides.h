// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

inline bool is_degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// One side of a triangle: it lies on the edge {lo, hi}, lo < hi.
struct EdgeSide {
  Index lo, hi;
  Index triangle;
  int side;      ///< from the triangle's corner `side` to the next
  bool forward;  ///< runs from lo to hi

  /// Corners of all triangles are numbered 3 t + i.
  std::size_t corner_at_lo() const { return corner(forward ? side : (side + 1) % 3); }
  std::size_t corner_at_hi() const { return corner(forward ? (side + 1) % 3 : side); }

 private:
  std::size_t corner(int i) const {
    return 3 * static_cast<std::size_t>(triangle) + static_cast<std::size_t>(i);
  }
};

/// All sides of the triangles that are not degenerate, those of one edge next to each other, in
/// the order of lo, hi and triangle. Indices must be in range.
std::vector<EdgeSide> sorted_edge_sides(std::span<const Triangle> triangles,
                                        std::size_t point_count);

/// Calls visit(span of EdgeSide) once per edge.
template <class Visit>
void for_each_edge(std::span<const EdgeSide> sides, Visit&& visit) {
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].lo == sides[begin].lo &&
           sides[end].hi == sides[begin].hi) {
      ++end;
    }
    visit(sides.subspan(begin, end - begin));
    begin = end;
  }
}

/// Triangles that share an edge, however many share it, in one set.
DisjointSets connected_triangles(std::span<const EdgeSide> sides, std::size_t triangle_count);

}  // namespace mesamis
