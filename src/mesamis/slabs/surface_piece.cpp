// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/surface_piece.h"

#include <span>

#include "mesamis/slabs/point_numbers.h"
#include "mesamis/surface/half_edges.h"

namespace mesamis::detail::slabs {

SurfacePiece join(const std::vector<SurfacePiece>& pieces) {
  SurfacePiece joined;
  PointNumbers numbers;
  for (const SurfacePiece& piece : pieces) {
    std::vector<Index> number;
    number.reserve(piece.points.size());
    for (const SurfacePoint& p : piece.points) {
      const auto [at, is_new] = numbers.of(p.key);
      number.push_back(at);
      if (is_new) {
        joined.points.push_back(p);
      } else {
        joined.points[at].settled |= p.settled;
      }
    }
    for (Triangle t : piece.triangles) {
      for (Index& corner : t) corner = number[corner];
      joined.triangles.push_back(t);
    }
  }
  return joined;
}

SurfacePiece select(const SurfacePiece& piece, const std::vector<char>& chosen) {
  SurfacePiece selected;
  std::vector<Index> number(piece.points.size(), kNoIndex);
  for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
    if (chosen[t] == 0) continue;
    for (const Index p : piece.triangles[t]) number[p] = 0;
  }
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] == kNoIndex) continue;
    number[p] = static_cast<Index>(selected.points.size());
    selected.points.push_back(piece.points[p]);
  }
  for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
    if (chosen[t] == 0) continue;
    Triangle& triangle = selected.triangles.emplace_back(piece.triangles[t]);
    for (Index& p : triangle) p = number[p];
  }
  return selected;
}

std::vector<char> rim_of(const SurfacePiece& piece) {
  std::vector<char> rim(piece.points.size(), 0);
  const auto half_edges = sorted_half_edges(piece.triangles, piece.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() == 1) rim[edge[0].lo] = rim[edge[0].hi] = 1;
  });
  return rim;
}

void settle_rim(SurfacePiece& piece) {
  const std::vector<char> rim = rim_of(piece);
  for (std::size_t p = 0; p < rim.size(); ++p) piece.points[p].settled |= rim[p] != 0;
}

void settle_all(SurfacePiece& piece) {
  for (SurfacePoint& p : piece.points) p.settled = true;
}

TriMesh mesh_of(const SurfacePiece& piece, Vec3 SurfacePoint::*place) {
  TriMesh mesh{{}, piece.triangles};
  mesh.points.reserve(piece.points.size());
  for (const SurfacePoint& p : piece.points) mesh.points.push_back(p.*place);
  return mesh;
}

void add_surface(ArchiveWriter& archive, const SurfacePiece& piece) {
  archive.add(piece.points);
  archive.add(piece.triangles);
}

SurfacePiece next_surface(ArchiveReader& archive) {
  SurfacePiece piece;
  piece.points = archive.next<SurfacePoint>();
  piece.triangles = archive.next<Triangle>();
  return piece;
}

}  // namespace mesamis::detail::slabs
