// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/manifold_skin.h"

#include <gtest/gtest.h>

#include <random>

#include "remesh/small_body.h"

namespace mesamis {
namespace {

const FormulaMetric kMetric = uniform_metric(0.25);
const PlaneShape kHalf({0, 0, 1}, 0.5, 1, kOutside);

/// Of bricks' cells, those in bricks that `wanted` names, by their numbers, are inside.
template <class Wanted>
SmallBody body_of(int along, Wanted wanted) {
  SmallBody body(box_mesh(kUnitBox, {along, along, along}), kMetric, kHalf);
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    Vec3 sum;
    for (const Index p : body.mesh.cells[c].points) sum += body.mesh.vertices[p].position;
    const Vec3 at = 0.25 * along * sum;
    body.mesh.cells[c].material = wanted(int(at.x), int(at.y), int(at.z)) ? 1 : kOutside;
  }
  return body;
}

TetMesh inside_of(const WorkingMesh& mesh) {
  TetMesh inside;
  for (const Vertex& vertex : mesh.vertices) inside.points.push_back(vertex.position);
  for (const WorkCell& cell : mesh.cells) {
    if (cell.material != kOutside) inside.cells.push_back(cell.points);
  }
  return inside;
}

TEST(ManifoldSkin, LeavesASoundBodyAlone) {
  SmallBody body = body_of(4, [](int x, int, int z) { return x > 0 && z < 3; });
  EXPECT_EQ(make_skin_manifold(body.bench), 0);
}

TEST(ManifoldSkin, BricksThatMeetInAnEdgeTouchNoMore) {
  SmallBody body = body_of(4, [](int x, int y, int z) {
    return (x == 1 && y == 1 && z > 0) || (x == 2 && y == 2 && z > 0);
  });
  ASSERT_NE(boundary_flaws(inside_of(body.mesh)), "");
  EXPECT_GT(make_skin_manifold(body.bench), 0);
  EXPECT_EQ(boundary_flaws(inside_of(body.mesh)), "");
  EXPECT_FALSE(inside_of(body.mesh).cells.empty());
}

TEST(ManifoldSkin, CellsAtRandomTouchNoMore) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    SmallBody body = body_of(6, [&](int x, int y, int z) {
      const bool at_border = std::min({x, y, z}) == 0 || std::max({x, y, z}) == 5;
      return !at_border && (random() & 7) < 3;
    });
    make_skin_manifold(body.bench);
    EXPECT_EQ(boundary_flaws(inside_of(body.mesh)), "") << seed;
  }
}

}  // namespace
}  // namespace mesamis
