// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "mesamis/remesh/skin.h"
#include "remesh/small_mesh.h"
#include "support/body_shapes.h"

namespace mesamis {

/// Bricks of the unit box, whose cells get the material of their middle.
struct SmallBody : SmallMesh {
  SmallBody(const TetMesh& start, const MetricField& field, const BodyShape& shape)
      : SmallMesh(start, field) {
    mesh.shape = &shape;
    for (WorkCell& cell : mesh.cells) {
      Vec3 sum;
      for (const Index p : cell.points) sum += mesh.vertices[p].position;
      cell.material = shape.material_at(0.25 * sum);
    }
    for (Index c = 0; c < std::ssize(mesh.cells); ++c) mark_skin(c);
  }

  Index vertex_at(const Vec3& p) const {
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const Vertex& vertex = mesh.vertices[v];
      if (vertex.cell != kNoIndex && norm(vertex.position - p) < 1e-9) return static_cast<Index>(v);
    }
    return kNoIndex;
  }

  Index vertex_near(const Vec3& p) const {
    const auto far = [&](const Vertex& v) {
      return v.cell == kNoIndex ? 1e9 : norm(v.position - p);
    };
    return static_cast<Index>(std::ranges::min_element(mesh.vertices, {}, far) -
                              mesh.vertices.begin());
  }

  std::vector<Index> ball(Index v) {
    std::vector<Index> cells;
    bench.cavity.collect_ball(v, cells);
    return cells;
  }

  Features edge(const Vec3& a, const Vec3& b) {
    const Index from = vertex_at(a), to = vertex_at(b);
    EXPECT_TRUE(bench.cavity.find_shell(cell_with(mesh, from, to), from, to));
    return edge_features(mesh, bench.cavity, {from, to});
  }

 private:
  void mark_skin(Index c) {
    for (int f = 0; f < 4 && mesh.cells[c].alive(); ++f) {
      if (!is_skin(mesh, c, f)) continue;
      for (const int i : kCellFaces[f]) mesh.vertices[mesh.cells[c].points[i]].mask |= kOnSkin;
    }
  }
};

/// A body's working mesh: neighbours, positive cells with the qualities kept beside them, and an
/// inside whose boundary is a closed 2-manifold.
inline void expect_sound_body(const WorkingMesh& mesh) {
  expect_neighbors_right(mesh);
  for (const WorkCell& cell : mesh.cells) {
    if (!cell.alive()) continue;
    ASSERT_GT(cell.quality3, 0);
    ASSERT_FLOAT_EQ(cell.quality3, static_cast<float>(quality3(mesh, cell.points)));
  }
  TetMesh inside;
  for (const Vertex& vertex : mesh.vertices) inside.points.push_back(vertex.position);
  for (const WorkCell& cell : mesh.cells) {
    if (cell.alive() && cell.material != kOutside) inside.cells.push_back(cell.points);
  }
  ASSERT_EQ(boundary_flaws(inside), "");
}

/// Of the inside.
inline double volume_of(const WorkingMesh& mesh) {
  double sum = 0;
  for (const WorkCell& cell : mesh.cells) {
    if (!cell.alive() || cell.material == kOutside) continue;
    const auto at = [&](std::size_t i) { return mesh.vertices[cell.points[i]].position; };
    sum += six_volume(at(0), at(1), at(2), at(3)) / 6;
  }
  return sum;
}

}  // namespace mesamis
