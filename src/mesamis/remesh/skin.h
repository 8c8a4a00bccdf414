// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bitset>
#include <span>

#include "mesamis/remesh/workbench.h"

/// The skin of a body: the faces between two materials, or between one and the outside, which is
/// not meshed. Faces on the planes of the box are no skin. Without a shape there is none.
namespace mesamis::remeshing {

/// What meets at a vertex or at an edge.
struct Features {
  std::bitset<256> materials;  ///< of the cells around, and of the outside where a skin faces it
  unsigned planes = 0;         ///< of the box

  bool on_skin() const { return materials.count() > 1; }
  /// How many directions a vertex there can move in: 3 inside, 0 where it must stay.
  int freedom() const;
  friend bool operator==(const Features&, const Features&) = default;
};

/// Whether a face belongs to the skin. Between parts of the mesh a face of three frozen vertices
/// may lie on the border of a part: it must not be asked for.
bool is_skin(const WorkingMesh& mesh, Index cell, int face);

/// Of a vertex that is not frozen, from the cells around it.
Features vertex_features(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex);

/// Of the edge whose shell was found last; not both its ends are frozen.
Features edge_features(const WorkingMesh& mesh, const Cavity& cavity, std::array<Index, 2> edge);

/// The place on the features that is nearest, or near it where planes count too.
Vec3 onto_features(const WorkingMesh& mesh, Vec3 position, const Features& features);

/// The normal of the skin around a vertex, of length 1, weighted by area; of one side where it is
/// between two materials.
Vec3 skin_normal(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex);

/// How far a point lies from the border, in tolerances.
double deviation(const WorkingMesh& mesh, const Vec3& p);

using Corners3 = std::array<Vec3, 3>;

/// Whether new triangles may take the place of old ones of the skin: each is turned by at most 60
/// degrees from the one in its place, or from any where their numbers differ, and they lie within
/// the tolerance of the border, or no farther than the old ones.
bool may_replace_skin(const WorkingMesh& mesh, std::span<const Corners3> old_triangles,
                      std::span<const Corners3> new_triangles);

/// The triangles of the skin at a vertex, each turned alike.
/// @param at  where the vertex is taken to be.
std::vector<Corners3> skin_triangles(const WorkingMesh& mesh, std::span<const Index> ball,
                                     Index vertex, const Vec3& at);

/// Whether a vertex of a body may be moved onto its neighbour: with the same connectivity of skin
/// and body afterwards (the link condition); one of the skin only along all its features, and if
/// the skin is one that may_replace_skin().
/// @param ball  the cells around the vertex.
bool may_collapse_in_body(Workbench& bench, std::span<const Index> ball, Index vertex, Index onto);

/// Whether the cells proposed have an edge that the old ones have not, but that is there elsewhere.
/// In a mesh of a box that cannot be; a body may touch itself.
bool makes_edge_twice(Workbench& bench, std::span<const Index> old_cells);

/// Whether two vertices have an edge between them; taken for granted where both are frozen.
bool has_edge(Workbench& bench, Index a, Index b);

}  // namespace mesamis::remeshing
