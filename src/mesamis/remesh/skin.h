// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bitset>
#include <optional>
#include <span>
#include <vector>

#include "mesamis/remesh/body_shape.h"
#include "mesamis/remesh/workbench.h"

/// The skin of a body: the faces between two materials, of which the outside is one. Faces on the
/// planes of the box are no skin.
namespace mesamis::detail::remesh {

/// What meets at a vertex or at an edge.
struct Features {
  std::bitset<256> materials;  ///< of the cells around
  unsigned planes = 0;         ///< of the box

  bool on_skin() const { return materials.count() > 1; }
  /// How many directions a vertex there can move in: 3 inside, 0 where it must stay.
  int freedom() const;
  /// The materials where just three meet.
  std::optional<MaterialTriple> junction() const;
  friend bool operator==(const Features&, const Features&) = default;
};

/// Whether a face belongs to the skin. Between parts of the mesh a face of three frozen vertices
/// may lie on the border of a part: it must not be asked for.
bool is_skin(const WorkingMesh& mesh, Index cell, int face);

/// Of a vertex that is not frozen, from the cells around it.
Features vertex_features(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex);

/// Of the edge whose shell was found last; not both its ends are frozen.
Features edge_features(const WorkingMesh& mesh, const Cavity& cavity, std::array<Index, 2> edge);

/// The nearest point of the line where the three materials of the features meet; none of others.
std::optional<JunctionPoint> nearest_junction(const WorkingMesh& mesh, const Vec3& p,
                                              const Features& features);

/// The place on the features that is nearest, or near it where planes count too: on the border, or
/// where three materials meet on their line.
Vec3 onto_features(const WorkingMesh& mesh, Vec3 position, const Features& features);

/// The normal of the skin around a vertex, of length 1, weighted by area; of one side where it is
/// between two materials.
Vec3 skin_normal(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex);

/// How far a point lies from the border, in tolerances; with features of three materials, from
/// their line.
double deviation(const WorkingMesh& mesh, const Vec3& p, const Features& features = {});

using Corners3 = std::array<Vec3, 3>;

/// Whether each new triangle is turned by at most 60 degrees from the old one in its place, or from
/// any where their numbers differ.
bool are_turned_little(std::span<const Corners3> old_triangles,
                       std::span<const Corners3> new_triangles);

/// Whether new triangles may take the place of old ones of the skin: they are turned little, and
/// lie within the tolerance of the border, or no farther than the old ones.
bool may_replace_skin(const WorkingMesh& mesh, std::span<const Corners3> old_triangles,
                      std::span<const Corners3> new_triangles);

/// The triangles of the skin at a vertex, each turned alike.
/// @param at  where the vertex is taken to be.
std::vector<Corners3> skin_triangles(const WorkingMesh& mesh, std::span<const Index> ball,
                                     Index vertex, const Vec3& at);

/// Whether a vertex of a body may be moved onto its neighbour: one of the skin only along all its
/// features, with the same connectivity of the skin afterwards (the link condition), and if the
/// new skin is one that may_replace_skin().
/// @param ball  the cells around the vertex.
bool may_collapse_in_body(Workbench& bench, std::span<const Index> ball, Index vertex, Index onto);

}  // namespace mesamis::detail::remesh
