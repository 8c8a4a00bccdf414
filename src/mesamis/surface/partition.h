// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

/// Surfaces of several objects that share their boundaries: space is divided among materials, and
/// the boundary between two of them is one sheet of triangles.
namespace mesamis::detail::surface {

/// The boundaries between the materials that fill a box.
struct PartitionSurface {
  std::vector<Vec3> points;  ///< mm
  std::vector<Triangle> triangles;
  /// The materials behind and in front of each triangle: seen from the second, the triangle turns
  /// counter-clockwise. The first is the smaller one; kNoIndex is second and means outside the box.
  std::vector<std::array<Index, 2>> sides;
};

/// The surface of a partition, which is left without.
inline TriMesh taken_from(PartitionSurface& partition) {
  return {std::move(partition.points), std::move(partition.triangles)};
}

/// A partition with another surface of as many triangles.
inline PartitionSurface put_back(TriMesh surface, PartitionSurface partition) {
  partition.points = std::move(surface.points);
  partition.triangles = std::move(surface.triangles);
  return partition;
}

/// How extract_partition() treats the box.
struct PartitionOptions {
  bool close_at_box = true;  ///< cap every material where it meets the box, so that it is closed
};

/// Extracts the boundaries between materials by marching tetrahedra for many materials.
///
/// Material k has the membership p_k, linear on each cell. At a node the material of the largest
/// membership wins, the first of several. An edge whose nodes belong to a and b is cut where
/// p_a = p_b, a face of three materials has a point where their memberships are equal, and so has a
/// cell of four. Points are kept in the inside of their edge, face or cell, see kCrossingMargin.
/// In cells of three or more materials the boundary is the cone over its curves on the faces.
///
/// The points depend on the nodes of their own edge, face or cell alone. So the sheets meet without
/// gaps, materials neither overlap nor leave anything of the box free, the boundary of each is a
/// closed 2-manifold, see object_surface(), and nothing intersects. With two materials it is the
/// surface of extract_solid() for p_1 - p_0 at the level 0.
///
/// @param mesh         a valid mesh of a box, n nodes, m cells, mm.
/// @param memberships  one field per material, n values each, finite, any unit; at least one field.
///                     Material 0 is the background.
/// @return points in mm, in the order of the nodes that they lie between.
/// @throws InputError  if the sizes differ or a value is not finite.
///
/// O(n * materials + m + s log s) for s triangles. The same bits for any number of threads.
PartitionSurface extract_partition(const TetMesh& mesh,
                                   std::span<const std::vector<double>> memberships,
                                   const PartitionOptions& options = {});

/// Takes the boundary of one material out of a partition: closed if the partition was closed at the
/// box, 2-manifold, oriented outward.
/// @param partition  s triangles, mm.
/// @param material   one of its sides; others have no triangles.
/// @return points in mm, those that the material's triangles use, in their order; triangles in
///         their order.
///
/// O(s + t log t) for t triangles of the material.
TriMesh object_surface(const PartitionSurface& partition, Index material);

/// Takes the boundaries of several materials out of a partition, in one walk over its triangles.
/// @param partition  s triangles, mm.
/// @param materials  each once.
/// @return what object_surface() returns for each material, in their order; mm.
///
/// O(s + t log t) for t triangles of all these materials.
std::vector<TriMesh> object_surfaces(const PartitionSurface& partition,
                                     std::span<const Index> materials);

/// Marks the points of a partition where more than two materials meet. O(s) for s triangles.
/// @return 1 or 0 for each point.
std::vector<char> curve_points(const PartitionSurface& partition);

/// Lists the materials of a partition. O(s) for s triangles, up to a logarithm.
/// @return increasing; without kNoIndex.
std::vector<Index> materials_of(const PartitionSurface& partition);

}  // namespace mesamis::detail::surface
