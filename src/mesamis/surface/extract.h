// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// How extract_solid() treats the box and the places between nodes.
struct SolidOptions {
  bool close_at_box = true;  ///< cap the object where it meets the box, so that it is closed
  /// The box, mm; default: that of the mesh. A part of a mesh is not closed where others go on.
  std::optional<Box> box{};
  /// Where the object's surface crosses the edge from a to b (mm), 0 at a to 1 at b; none: where
  /// the linear function does. For a function that is known between the nodes. Called in threads.
  std::function<double(const Vec3& a, const Vec3& b)> crossing{};
  /// Where > 0, crossings become one point that keeps so near to them, see snap_nodes(); unit of the
  /// mesh.
  double snap = 0;
};

/// Crossings keep this distance from an edge's ends, relative to the edge: they stay distinct,
/// also after rounding to single precision, where a value at a node is at the level or near it.
/// The surface is moved by less than that: at most 0.005 of an edge, 2.5e-5 in the mean.
inline constexpr double kCrossingMargin = 0.005;
/// The same for crossings that are known exactly: enough for double precision.
inline constexpr double kExactCrossingMargin = 1e-4;

/// Extracts the boundary of {u > level} for u linear on each cell: its level set, welded.
///
/// Combinatorially it is a closed 2-manifold oriented outward, for any values: a node exactly at
/// the level counts as outside. It does not cut itself: within a cell it stays between the cell's
/// own crossings.
///
/// @param mesh   a valid mesh of a box, n nodes, m cells, mm.
/// @param u      n values of any unit, finite.
/// @param level  in the unit of u, finite.
/// @return points in mm, one per crossed edge (and per node inside, on the box), in the order of
///         the edges; empty if no node is above the level.
/// @throws InputError  if the sizes differ or a value is not finite.
///
/// O(m + s log s) for s triangles. The same bits for any number of threads.
TriMesh extract_solid(const TetMesh& mesh, std::span<const double> u, double level,
                      const SolidOptions& options = {});

/// Finds the cells whose centroid value of v is below the threshold: the paper's T_h^th.
/// @param mesh       n nodes, m cells.
/// @param v          n values, finite, no unit.
/// @param threshold  finite, no unit.
/// @return indices in increasing order.
/// @throws InputError  if the sizes differ or a value is not finite.
std::vector<Index> band_cells(const TetMesh& mesh, std::span<const double> v, double threshold);

/// Extracts the boundary of the union of the band's cells: the paper's Sigma_h, one skin on each
/// side of an image edge.
///
/// It is closed, 2-manifold and oriented out of the band. Points and edges where cells only touch
/// are split into copies at the same place, one for each side; a file format that joins equal
/// points (STL) joins them again.
///
/// @param mesh       a valid mesh of a box, n nodes, m cells, mm.
/// @param v          n values, finite, no unit.
/// @param threshold  finite, no unit.
/// @return points in mm.
/// @throws InputError  as band_cells().
///
/// O(m log d) for at most d cells at a node.
TriMesh extract_band(const TetMesh& mesh, std::span<const double> v, double threshold);

}  // namespace mesamis::detail::surface
