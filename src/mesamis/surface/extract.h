// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

struct SolidOptions {
  bool close_at_box = true;  ///< cap the object where it meets the box, so that it is closed
  /// Where the object's surface crosses the edge from a to b, 0 at a to 1 at b; none: where the
  /// linear function does. For a function that is known between the nodes.
  std::function<double(const Vec3& a, const Vec3& b)> crossing{};
};

/// Crossings keep this distance from an edge's ends, relative to the edge: they stay distinct,
/// also after rounding to single precision, where a value at a node is at the level or near it.
/// The surface is moved by less than that: at most 0.005 of an edge, 2.5e-5 in the mean.
inline constexpr double kCrossingMargin = 0.005;
/// The same for crossings that are known exactly: enough for double precision.
inline constexpr double kExactCrossingMargin = 1e-4;

/// The boundary of {u > level}: u linear on each cell, the surface its level set, welded.
///
/// Combinatorially a closed oriented 2-manifold with outward orientation, whatever the values:
/// a node exactly at the level counts as outside. It does not cut itself: within a cell it stays
/// between the cell's own crossings.
///
/// @param mesh   a valid mesh of a box.
/// @param u      one value per node, finite.
/// @param level  in the units of u, finite.
/// @return points in mm, one per crossed edge (and per node inside, on the box), in the order of
///         the edges; empty if no node is above the level.
/// @throws InputError  if the sizes differ or a value is not finite.
TriMesh extract_solid(const TetMesh& mesh, std::span<const double> u, double level,
                      const SolidOptions& options = {});

/// Cells whose centroid value of v is below the threshold: the paper's T_h^th.
/// @throws InputError  if the sizes differ or a value is not finite.
std::vector<Index> band_cells(const TetMesh& mesh, std::span<const double> v, double threshold);

/// The boundary of the union of the band's cells: the paper's Sigma_h, one skin on each side
/// of an edge; closed, oriented out of the band. Points and edges where cells only touch are
/// split into copies at the same place, one for each side, so that it is 2-manifold; a file format
/// that joins equal points (STL) joins them again.
/// @throws InputError  as band_cells.
TriMesh extract_band(const TetMesh& mesh, std::span<const double> v, double threshold);

}  // namespace mesamis
