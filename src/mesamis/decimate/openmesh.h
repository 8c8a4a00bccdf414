// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

/// The half-edges of a surface, for what changes its connectivity.
namespace mesamis::detail::decimate {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

inline std::size_t index(OpenMesh::BaseHandle h) { return static_cast<std::size_t>(h.idx()); }

inline Triangle corner_indices(const HalfedgeMesh& mesh, OpenMesh::FaceHandle f) {
  auto v = mesh.cfv_iter(f);
  const Index a = (*v).idx(), b = (*++v).idx(), c = (*++v).idx();
  return {a, b, c};
}

/// Adds points and triangles to an empty mesh, in their order, and asks for what collapses need.
/// @param surface  2-manifold.
/// @param origin   is taken off the points.
inline void build_halfedges(const TriMesh& surface, const Vec3& origin, HalfedgeMesh& mesh) {
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_halfedge_status();
  mesh.request_face_status();
  for (const Vec3& p : surface.points) {
    mesh.add_vertex({p.x - origin.x, p.y - origin.y, p.z - origin.z});
  }
  for (const Triangle& t : surface.triangles) {
    mesh.add_face(OpenMesh::VertexHandle(t[0]), OpenMesh::VertexHandle(t[1]),
                  OpenMesh::VertexHandle(t[2]));
  }
}

/// The triangles that are left, in their order.
inline std::vector<Triangle> remaining_triangles(const HalfedgeMesh& mesh) {
  std::vector<Triangle> triangles;
  for (const auto f : mesh.faces()) {
    if (!mesh.status(f).deleted()) triangles.push_back(corner_indices(mesh, f));
  }
  return triangles;
}

/// May the half-edge be collapsed with the surface staying a closed 2-manifold?
inline bool keeps_manifold(HalfedgeMesh& mesh, OpenMesh::HalfedgeHandle h) {
  if (!mesh.is_collapse_ok(h)) return false;
  const auto left = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
  const auto right =
      mesh.to_vertex_handle(mesh.next_halfedge_handle(mesh.opposite_halfedge_handle(h)));
  return mesh.valence(left) > 3 && mesh.valence(right) > 3;
}

}  // namespace mesamis::detail::decimate
