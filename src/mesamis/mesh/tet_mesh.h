// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mesamis/base/types.h"

namespace mesamis {

/// Four point indices; positive orientation: (p1-p0) x (p2-p0) . (p3-p0) > 0.
using Cell = std::array<Index, 4>;

/// A conforming tetrahedral mesh of an axis-aligned box, coordinates in mm.
struct TetMesh {
  std::vector<Vec3> points;
  std::vector<Cell> cells;
};

/// The face opposite vertex i, ordered so that its normal points out of a positive cell.
inline constexpr std::array<std::array<int, 3>, 4> kCellFaces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
inline constexpr std::array<std::array<int, 2>, 6> kCellEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Six times the signed volume of (a, b, c, d).
inline double six_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(cross(b - a, c - a), d - a);
}
inline std::array<Vec3, 4> cell_corners(const TetMesh& mesh, const Cell& cell) {
  return {mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]], mesh.points[cell[3]]};
}
double cell_volume(const TetMesh& mesh, Index cell);

/// The points of the face opposite local point `face`, in increasing order: the same from both its
/// cells.
std::array<Index, 3> sorted_face(const Cell& cell, int face);

/// The smallest box around the points.
Box bounding_box(std::span<const Vec3> points);

/// A box of n[0] x n[1] x n[2] bricks, each cut into the six Kuhn tetrahedra around its main
/// diagonal. Points run in x fastest; the outer points lie exactly on the box.
/// @throws InputError  if a count is below 1, the box is empty or the mesh exceeds 32-bit indices.
TetMesh box_mesh(const Box& box, const std::array<Index, 3>& n);

/// A box mesh of a few bricks, none much longer than another: what a remesher can start from.
TetMesh coarse_box_mesh(const Box& box);

/// For each cell the cell across the face opposite vertex i, or kNoIndex on the boundary. Only the
/// cells are looked at; their indices are from 0. O(m).
/// @throws InputError  if a face is shared by more than two cells, or a cell names a point that is
///                     not there (where there are any).
std::vector<std::array<Index, 4>> cell_neighbors(const TetMesh& mesh);

/// Cells around each point, in increasing order: those of point n are
/// cells[start[n]] ... cells[start[n + 1] - 1].
struct PointCells {
  std::vector<std::int64_t> start;
  std::vector<Index> cells;
  std::span<const Index> of(Index point) const {
    const auto begin = start[static_cast<std::size_t>(point)];
    return {cells.data() + begin,
            static_cast<std::size_t>(start[static_cast<std::size_t>(point) + 1] - begin)};
  }
};
PointCells point_cells(const TetMesh& mesh);

/// What is wrong with a mesh that should fill the box; empty when nothing is.
///
/// Checked: indices in range, finite coordinates, every point used, certified positive cells,
/// faces shared by two cells or lying in one box plane, total volume equal to the box's to
/// 1e-12 relative. Conforming and filling follow from these together.
std::string find_flaw(const TetMesh& mesh, const Box& box);

/// @throws NumericalError  with find_flaw's words, if there is a flaw.
void validate(const TetMesh& mesh, const Box& box);

}  // namespace mesamis
