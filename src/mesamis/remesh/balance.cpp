// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/balance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesamis/remesh/body_shape.h"
#include "mesamis/remesh/skin.h"

namespace mesamis::detail::remesh {
namespace {

/// How far the border lies from triangles, along their normals and in the mean over their area:
/// that of the middles of the sides, exact for a border that bends like a parabola.
double mean_offset(const BodyShape& shape, std::span<const Corners3> triangles) {
  double sum = 0, area = 0;
  for (const Corners3& t : triangles) {
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);  // of twice the area
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 middle = 0.5 * (t[i] + t[(i + 1) % 3]);
      sum += dot(shape.nearest_border(middle).point - middle, normal) / 3;
    }
    area += norm(normal);
  }
  return area > 0 ? sum / area : 0;
}

/// Vertices are not moved by less than this share of the tolerance.
constexpr double kLeastOffset = 0.01;

bool balance_vertex(Workbench& bench, Index v, std::span<const Index> ball, const ShapeRule& rule) {
  WorkingMesh& mesh = bench.mesh;
  const Features features = vertex_features(mesh, ball, v);
  if (features.freedom() != 2 || !features.on_skin()) return false;
  Vertex& vertex = mesh.vertices[v];
  const Vec3 here = vertex.position;
  const auto before = skin_triangles(mesh, ball, v, here);
  const double offset = mean_offset(*mesh.shape, before);
  if (std::abs(offset) < kLeastOffset * mesh.shape->nearest_border(here).tolerance) return false;
  const double worst = std::min(1.0, worst_score_inside(mesh, ball, rule));
  vertex.position = here + offset * skin_normal(mesh, ball, v);
  if (mesh.box.contains(vertex.position) && planes_of(mesh.box, vertex.position) == 0 &&
      deviation(mesh, vertex.position) <= 1 && are_positive(mesh, ball) &&
      worst_score_inside(mesh, ball, rule) >= worst &&
      are_turned_little(before, skin_triangles(mesh, ball, v, vertex.position))) {
    settle_moved(bench, v, ball);
    return true;
  }
  vertex.position = here;
  return false;
}

}  // namespace

Counters balance_skin(Workbench& bench, const ShapeRule& rule) {
  WorkingMesh& mesh = bench.mesh;
  Counters done;
  std::vector<Index> ball;
  for (Index v = 0; v < std::ssize(mesh.vertices); ++v) {
    const Vertex& vertex = mesh.vertices[v];
    if (vertex.cell == kNoIndex || !(vertex.mask & kOnSkin) || (vertex.mask & kFrozen)) continue;
    bench.cavity.collect_ball(v, ball);
    if (!ball.empty()) done.moves += balance_vertex(bench, v, ball, rule);
  }
  return done;
}

}  // namespace mesamis::detail::remesh
