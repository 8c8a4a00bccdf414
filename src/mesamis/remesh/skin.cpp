// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/skin.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "mesamis/mesh/edges.h"

namespace mesamis::detail::remesh {
namespace {

/// The points of a face, turned out of its cell.
std::array<Index, 3> face_points(const Cell& cell, int face) {
  const auto& f = kCellFaces[static_cast<std::size_t>(face)];
  return {cell[f[0]], cell[f[1]], cell[f[2]]};
}

/// Calls visit(cell, face) for the faces of the skin at a vertex. A face between two materials is
/// visited once, from the one with the lower number.
template <class Visit>
void for_each_skin_face(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex,
                        Visit&& visit) {
  for (const Index c : ball) {
    const WorkCell& cell = mesh.cells[c];
    for (int f = 0; f < 4; ++f) {
      if (cell.points[f] == vertex || !is_skin(mesh, c, f)) continue;
      if (mesh.cells[cell_of(cell.neighbors[f])].material < cell.material) continue;
      visit(c, f);
    }
  }
}

Vec3 area_normal(const Corners3& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// How far a triangle's middle and the middles of its sides lie from the border, in tolerances.
double deviation(const WorkingMesh& mesh, const Corners3& t) {
  double farthest = deviation(mesh, (1.0 / 3) * (t[0] + t[1] + t[2]));
  for (std::size_t i = 0; i < 3; ++i) {
    farthest = std::max(farthest, deviation(mesh, 0.5 * (t[i] + t[(i + 1) % 3])));
  }
  return farthest;
}

double deviation(const WorkingMesh& mesh, std::span<const Corners3> triangles) {
  double farthest = 0;
  for (const Corners3& t : triangles) farthest = std::max(farthest, deviation(mesh, t));
  return farthest;
}

/// Whether a triangle is turned by at most 60 degrees from one of others.
bool is_turned_little(std::span<const Corners3> others, const Corners3& triangle) {
  constexpr double kMostTurn = 0.5;  // cosine
  const Vec3 normal = area_normal(triangle);
  return std::ranges::any_of(others, [&](const Corners3& other) {
    const Vec3 before = area_normal(other);
    return dot(normal, before) > kMostTurn * norm(normal) * norm(before);
  });
}

/// The vertices that faces of the skin at a vertex join to it.
void insert_skin_neighbors(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex,
                           VertexSet& into) {
  for_each_skin_face(mesh, ball, vertex, [&](Index c, int f) {
    for (const Index p : face_points(mesh.cells[c].points, f)) into.insert(p);
  });
}

/// The link condition for an edge of the skin: whatever of the skin meets both ends meets the edge
/// too. Else the collapse would glue two sheets of the skin together. That cells fill the box, and
/// stay positive, is the condition for the cells.
/// Source: Dey, Edelsbrunner, Guha and Nekhayev, Topology preserving edge contraction, 1999.
class LinkCondition {
 public:
  LinkCondition(Workbench& bench, std::span<const Index> ball, std::array<Index, 2> edge)
      : mesh_(bench.mesh),
        cavity_(bench.cavity),
        first_(bench.seen),
        second_(bench.met),
        ball_(ball),
        edge_(edge),
        other_ball_(bench.other_ball) {
    bench.cavity.collect_ball(edge[1], other_ball_);
  }

  bool holds() {
    return !other_ball_.empty() && no_cell_has_both_skins() && common_skin_is_at_edge();
  }

 private:
  /// A cell with a face of the skin opposite either end would leave two sheets behind.
  bool no_cell_has_both_skins() const {
    return std::ranges::none_of(cavity_.shell(), [this](Index c) {
      const Cell& points = mesh_.cells[c].points;
      return is_skin(mesh_, c, local_index(points, edge_[0])) &&
             is_skin(mesh_, c, local_index(points, edge_[1]));
    });
  }

  /// Points that the skin joins to both ends belong to faces of the skin at the edge.
  bool common_skin_is_at_edge() {
    first_.clear();
    second_.clear();
    insert_skin_neighbors(mesh_, ball_, edge_[0], first_);
    insert_skin_neighbors(mesh_, other_ball_, edge_[1], second_);
    for (const Index p : cavity_.ring()) {
      if (first_.insert(p) || second_.insert(p)) continue;
      if (!is_skin_at_edge(p)) return false;
    }
    return true;
  }

  bool is_skin_at_edge(Index p) const {
    for (const Index c : cavity_.shell()) {
      const Cell& points = mesh_.cells[c].points;
      if (local_index(points, p) < 0) continue;
      for (int f = 0; f < 4; ++f) {
        const Index other = points[f];
        if (other == p || other == edge_[0] || other == edge_[1]) continue;
        if (is_skin(mesh_, c, f)) return true;
      }
    }
    return false;
  }

  const WorkingMesh& mesh_;
  const Cavity& cavity_;
  VertexSet &first_, &second_;
  std::span<const Index> ball_;
  std::array<Index, 2> edge_;
  std::vector<Index>& other_ball_;
};

/// Whether the edge of the present shell has all features of its first end, and may change.
bool is_along_features(const Workbench& bench, std::span<const Index> ball,
                       std::array<Index, 2> edge) {
  const Vertex& target = bench.mesh.vertices[edge[1]];
  if (!(target.mask & kOnSkin) || (target.mask & kFrozen)) return false;
  return edge_features(bench.mesh, bench.cavity, edge) ==
         vertex_features(bench.mesh, ball, edge[0]);
}

/// Whether the skin may follow when its first point moves onto the second.
bool keeps_skin(const WorkingMesh& mesh, std::span<const Index> ball, std::array<Index, 2> move) {
  const auto before = skin_triangles(mesh, ball, move[0], mesh.vertices[move[0]].position);
  auto after = skin_triangles(mesh, ball, move[0], mesh.vertices[move[1]].position);
  std::erase_if(after, [&](const Corners3& t) {  // those that had both ends
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  return may_replace_skin(mesh, before, after);
}

/// Whether a neighbour is joined to the vertex along all features.
bool is_along(const WorkingMesh& mesh, std::span<const Index> ball, Index neighbor,
              const Features& features) {
  Features of_edge{{}, features.planes};
  for (const Index c : ball) {
    const WorkCell& cell = mesh.cells[c];
    if (local_index(cell.points, neighbor) >= 0) of_edge.materials.set(cell.material);
  }
  return of_edge == features;
}

/// Whether the line where three materials meet may follow when its first point moves onto the
/// second.
bool keeps_junction(const WorkingMesh& mesh, std::span<const Index> ball,
                    std::array<Index, 2> move) {
  const Features features = vertex_features(mesh, ball, move[0]);
  if (!features.junction()) return true;
  const auto at = [&](Index v) -> const Vec3& { return mesh.vertices[v].position; };
  for (const Index c : ball) {
    for (const Index p : mesh.cells[c].points) {
      if (p == move[0] || p == move[1] || !is_along(mesh, ball, p, features)) continue;
      const double after = deviation(mesh, 0.5 * (at(p) + at(move[1])), features);
      if (after > 1 && after > deviation(mesh, 0.5 * (at(p) + at(move[0])), features)) return false;
    }
  }
  return true;
}

}  // namespace

double deviation(const WorkingMesh& mesh, const Vec3& p, const Features& features) {
  const BorderPoint border = mesh.shape->nearest_border(p);
  const double off_border = norm(border.point - p);
  const auto line = nearest_junction(mesh, p, features);
  return std::max(off_border, line ? norm(line->point - p) : 0) / border.tolerance;
}

int Features::freedom() const {
  const auto met = static_cast<int>(materials.count());
  return std::max(0, 4 - met - std::popcount(planes));
}

std::optional<MaterialTriple> Features::junction() const {
  if (materials.count() != 3) return std::nullopt;
  MaterialTriple triple{};
  auto next = triple.begin();
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (materials[m]) *next++ = static_cast<Material>(m);
  }
  return triple;
}

std::optional<JunctionPoint> nearest_junction(const WorkingMesh& mesh, const Vec3& p,
                                              const Features& features) {
  const auto materials = features.junction();
  return materials ? mesh.shape->nearest_junction(p, *materials) : std::nullopt;
}

bool is_skin(const WorkingMesh& mesh, Index cell, int face) {
  const WorkCell& k = mesh.cells[cell];
  const FaceRef n = k.neighbors[face];
  return n != kNoIndex && mesh.cells[cell_of(n)].material != k.material;
}

Features vertex_features(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex) {
  Features features;
  features.planes = mesh.vertices[vertex].mask & kPlanes;
  for (const Index c : ball) features.materials.set(mesh.cells[c].material);
  return features;
}

Features edge_features(const WorkingMesh& mesh, const Cavity& cavity, std::array<Index, 2> edge) {
  Features features;
  features.planes = mesh.vertices[edge[0]].mask & mesh.vertices[edge[1]].mask & kPlanes;
  for (const Index c : cavity.shell()) features.materials.set(mesh.cells[c].material);
  return features;
}

Vec3 onto_features(const WorkingMesh& mesh, Vec3 position, const Features& features) {
  if (!features.on_skin()) return position;
  const int steps = features.planes == 0 ? 1 : 4;
  for (int step = 0; step < steps; ++step) {
    const auto line = nearest_junction(mesh, position, features);
    position = line ? line->point : mesh.shape->nearest_border(position).point;
    for (int axis = 0; axis < 3; ++axis) {
      if (features.planes >> (2 * axis) & 1) position[axis] = mesh.box.lo[axis];
      if (features.planes >> (2 * axis) & 2) position[axis] = mesh.box.hi[axis];
    }
  }
  return position;
}

Vec3 skin_normal(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex) {
  Vec3 sum;
  for (const Corners3& t : skin_triangles(mesh, ball, vertex, mesh.vertices[vertex].position)) {
    sum += area_normal(t);
  }
  return unit_or_zero(sum);
}

bool are_turned_little(std::span<const Corners3> old_triangles,
                       std::span<const Corners3> new_triangles) {
  const bool in_pairs = old_triangles.size() == new_triangles.size();
  for (std::size_t i = 0; i < new_triangles.size(); ++i) {
    const auto before = in_pairs ? old_triangles.subspan(i, 1) : old_triangles;
    if (!is_turned_little(before, new_triangles[i])) return false;
  }
  return true;
}

bool may_replace_skin(const WorkingMesh& mesh, std::span<const Corners3> old_triangles,
                      std::span<const Corners3> new_triangles) {
  if (!are_turned_little(old_triangles, new_triangles)) return false;
  const double after = deviation(mesh, new_triangles);
  return after <= 1 || after <= deviation(mesh, old_triangles);
}

std::vector<Corners3> skin_triangles(const WorkingMesh& mesh, std::span<const Index> ball,
                                     Index vertex, const Vec3& at) {
  std::vector<Corners3> triangles;
  for_each_skin_face(mesh, ball, vertex, [&](Index c, int f) {
    Corners3 corners;
    const auto points = face_points(mesh.cells[c].points, f);
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = points[i] == vertex ? at : mesh.vertices[points[i]].position;
    }
    triangles.push_back(corners);
  });
  return triangles;
}

bool may_collapse_in_body(Workbench& bench, std::span<const Index> ball, Index vertex, Index onto) {
  const WorkingMesh& mesh = bench.mesh;
  if (!(mesh.vertices[vertex].mask & kOnSkin)) return true;
  const auto cell = std::ranges::find_if(
      ball, [&](Index c) { return local_index(mesh.cells[c].points, onto) >= 0; });
  return cell != ball.end() && bench.cavity.find_shell(*cell, vertex, onto) &&
         is_along_features(bench, ball, {vertex, onto}) &&
         LinkCondition(bench, ball, {vertex, onto}).holds() &&
         keeps_skin(mesh, ball, {vertex, onto}) && keeps_junction(mesh, ball, {vertex, onto});
}

}  // namespace mesamis::detail::remesh
