// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/slabs/archive.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::slabs {

/// A point of the surface; length units, in the grid's own axes.
struct SurfacePoint {
  Vec3 key;  ///< where it was extracted: it tells the point from others in all pieces
  Vec3 at;   ///< where it is
  /// It is not to be moved, or removed, by the task that reads the piece: what is settled for one
  /// task need not be so for the next.
  bool settled = false;
};

/// Some triangles of the surface. Pieces have no numbers in common: a point of two pieces is known
/// by its key.
struct SurfacePiece {
  std::vector<SurfacePoint> points;
  std::vector<Triangle> triangles;
};

/// Joins pieces that share no triangle, in their order. Of a point of several pieces the first
/// one's place stays; it is settled if any of them says so. O(points and triangles).
SurfacePiece join(const std::vector<SurfacePiece>& pieces);

/// The triangles chosen, and their points, in their order.
/// @param chosen  1 or 0 for each triangle.
SurfacePiece select(const SurfacePiece& piece, const std::vector<char>& chosen);

/// Of each point 1 if it is on an edge of one triangle alone.
std::vector<char> rim_of(const SurfacePiece& piece);
/// Settles these points.
void settle_rim(SurfacePiece& piece);
/// Settles all points.
void settle_all(SurfacePiece& piece);

/// As the surface of all points and triangles; their keys or places.
TriMesh mesh_of(const SurfacePiece& piece, Vec3 SurfacePoint::*place);

void add_surface(ArchiveWriter& archive, const SurfacePiece& piece);
/// @throws InputError  as ArchiveReader::next().
SurfacePiece next_surface(ArchiveReader& archive);

}  // namespace mesamis::detail::slabs
