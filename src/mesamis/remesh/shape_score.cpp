// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/shape_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesamis/mesh/element_quality.h"
#include "mesamis/remesh/body_shape.h"
#include "mesamis/remesh/geometry.h"
#include "mesamis/remesh/skin.h"

namespace mesamis::detail::remesh {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

double least_angle(const Corners3& t) {
  double least = 60;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = t[(i + 1) % 3] - t[i], b = t[(i + 2) % 3] - t[i];
    least = std::min(least, kDegrees * std::atan2(norm(cross(a, b)), dot(a, b)));
  }
  return least;
}

/// Of the faces of a cell whose corners are all on the skin; 60 if there is none.
double least_skin_angle(const WorkingMesh& mesh, const Cell& points) {
  double least = 60;
  for (const auto& face : kCellFaces) {
    const auto vertex = [&](std::size_t i) -> const Vertex& {
      return mesh.vertices[points[static_cast<std::size_t>(face[i])]];
    };
    if (!(vertex(0).mask & vertex(1).mask & vertex(2).mask & kOnSkin)) continue;
    least =
        std::min(least, least_angle({vertex(0).position, vertex(1).position, vertex(2).position}));
  }
  return least;
}

}  // namespace

double shape_score(const WorkingMesh& mesh, const Cell& points, const ShapeRule& rule) {
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.vertices[points[i]].position;
  const ElementShape shape = element_shape(corners);
  return std::min({shape.least_angle / rule.least_angle,
                   (180 - shape.greatest_angle) / (180 - rule.greatest_angle),
                   shape.scaled_jacobian / rule.scaled_jacobian,
                   least_skin_angle(mesh, points) / rule.skin_angle});
}

double worst_score_inside(const WorkingMesh& mesh, std::span<const Index> cells,
                          const ShapeRule& rule) {
  double worst = INFINITY;
  for (const Index c : cells) {
    const WorkCell& cell = mesh.cells[c];
    if (cell.material != kOutside) worst = std::min(worst, shape_score(mesh, cell.points, rule));
  }
  return worst;
}

bool are_positive(const WorkingMesh& mesh, std::span<const Index> cells) {
  return std::ranges::all_of(
      cells, [&](Index c) { return quality3(mesh, mesh.cells[c].points) > kTinyQuality3; });
}

void settle_moved(Workbench& bench, Index vertex, std::span<const Index> ball) {
  WorkingMesh& mesh = bench.mesh;
  measure(mesh.vertices[vertex], bench.sampler, mesh.vertices[vertex].hint);
  for (const Index c : ball) {
    WorkCell& cell = mesh.cells[c];
    cell.quality3 = static_cast<float>(quality3(mesh, cell.points));
    cell.pending = kToAll;
    cell.tried = 0;
  }
}

}  // namespace mesamis::detail::remesh
