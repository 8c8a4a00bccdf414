// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesamis/base/types.h"

namespace mesamis {

/// Four point indices; positive orientation: (p1-p0) x (p2-p0) . (p3-p0) > 0.
using Cell = std::array<Index, 4>;

/// What fills a cell of a body: 0 outside, else one of its objects.
using Material = std::uint8_t;
inline constexpr Material kOutside = 0;

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

/// Six times the signed volume of (a, b, c, d): mm^3 for points in mm.
inline double six_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  return dot(cross(b - a, c - a), d - a);
}

/// The positions of a cell's four points, mm.
inline std::array<Vec3, 4> cell_corners(const TetMesh& mesh, const Cell& cell) noexcept {
  return {mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]], mesh.points[cell[3]]};
}

/// The signed volume of a cell, mm^3.
/// @param cell  an index in range.
double cell_volume(const TetMesh& mesh, Index cell);

/// The points of the face opposite local point `face`, in increasing order: the same from both its
/// cells.
/// @param face  0 to 3.
std::array<Index, 3> sorted_face(const Cell& cell, int face);

/// The smallest box around the points.
/// @param points  n points, mm; finite.
/// @return mm; from +infinity to -infinity if there are no points.
Box bounding_box(std::span<const Vec3> points);

/// The planes of a box that hold a point exactly: a bit each, x_lo x_hi y_lo y_hi z_lo z_hi from
/// the lowest on.
/// @param box, p  mm.
inline std::uint8_t planes_of(const Box& box, const Vec3& p) noexcept {
  unsigned mask = 0;
  for (int axis = 0; axis < 3; ++axis) {
    mask |= unsigned{p[axis] == box.lo[axis]} << (2 * axis);
    mask |= unsigned{p[axis] == box.hi[axis]} << (2 * axis + 1);
  }
  return static_cast<std::uint8_t>(mask);
}

/// Meshes a box of n[0] x n[1] x n[2] bricks, each cut into the six Kuhn tetrahedra around its main
/// diagonal. Points run in x fastest; the outer points lie exactly on the box.
/// @param box  mm.
/// @param n    bricks along each axis, at least 1.
/// @throws InputError  if a count is below 1, the box is empty or the mesh exceeds 32-bit indices.
TetMesh box_mesh(const Box& box, const std::array<Index, 3>& n);

/// Meshes a box with a few bricks of similar side lengths: a start for the remesher.
/// @param box  mm.
/// @throws InputError  if the box is empty.
///
/// O(1): at most 33 x 33 x 3 points.
TetMesh coarse_box_mesh(const Box& box);

/// Finds for each cell the cell across the face opposite vertex i, or kNoIndex on the boundary.
/// @param mesh  m cells; may come without points.
/// @throws InputError  if a face is shared by more than two cells, or a cell names a point below 0
///                     or, of a mesh with points, one that is missing.
///
/// O(m log d) for at most d cells at a point; 32 bytes per cell beside the result.
std::vector<std::array<Index, 4>> cell_neighbors(const TetMesh& mesh);

/// Cells around each point, in increasing order: those of point n are
/// cells[start[n]] ... cells[start[n + 1] - 1].
struct PointCells {
  std::vector<std::int64_t> start;
  std::vector<Index> cells;
  /// The cells around a point.
  std::span<const Index> of(Index point) const noexcept {
    const auto begin = start[static_cast<std::size_t>(point)];
    return {cells.data() + begin,
            static_cast<std::size_t>(start[static_cast<std::size_t>(point) + 1] - begin)};
  }
};

/// Lists the cells around each point.
/// @param mesh  n points, m cells; indices in range.
///
/// O(n + m); 16 bytes per cell and point.
PointCells point_cells(const TetMesh& mesh);

/// Names the first flaw of a mesh that should fill the box; empty if there is none.
///
/// Checked: indices in range, finite coordinates, every point used, certified positive cells,
/// faces shared by two cells or lying in one box plane, total volume equal to the box's to
/// 1e-12 relative. Together they imply that the mesh conforms and fills the box.
///
/// @param mesh  m cells, mm.
/// @param box   mm.
///
/// O(m log d), memory as cell_neighbors().
std::string find_flaw(const TetMesh& mesh, const Box& box);

/// Checks that a mesh fills the box. O(m), see find_flaw().
/// @param mesh, box  mm.
/// @throws NumericalError  with the flaw that find_flaw() names, if there is one.
void validate(const TetMesh& mesh, const Box& box);

}  // namespace mesamis
