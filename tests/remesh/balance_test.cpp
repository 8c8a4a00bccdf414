// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesamis/remesh/body.h"
#include "remesh/small_body.h"

namespace mesamis {
namespace {

const FormulaMetric kMetric = uniform_metric(0.12);
const RoundShape kBall({0.5, 0.5, 0.5}, 0.4);
const double kBallVolume = 4.0 / 3 * std::numbers::pi * 0.064;

double ball_volume(bool balanced) {
  RemeshOptions options;
  options.balanced = balanced;
  const BodyMesh body =
      remesh_body(perturbed_box(kUnitBox, {8, 8, 8}, 0.2), kMetric, kBall, options);
  EXPECT_EQ(boundary_flaws(body.mesh), "");
  double sum = 0;
  for (Index c = 0; c < std::ssize(body.mesh.cells); ++c) {
    EXPECT_GT(cell_volume(body.mesh, c), 0);
    sum += cell_volume(body.mesh, c);
  }
  return sum;
}

TEST(BalanceSkin, KeepsTheVolumeOfABall) {
  EXPECT_LT(ball_volume(false), 0.99 * kBallVolume);
  EXPECT_NEAR(ball_volume(true), kBallVolume, 0.003 * kBallVolume);
}

TEST(BalanceSkin, MovesNothingWhereTheSkinIsFlat) {
  const PlaneShape half({0, 0, 1}, 0.5, 1, kOutside);
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, half);
  const auto before = mesh_hash(unload(body.mesh));
  EXPECT_EQ(balance_skin(body.bench, {}).moves, 0);
  EXPECT_EQ(mesh_hash(unload(body.mesh)), before);
}

TEST(BalanceSkin, KeepsToTheToleranceAndToFrozenVertices) {
  SmallBody body(perturbed_box(kUnitBox, {8, 8, 8}, 0.2), kMetric, kBall);  // far off the ball
  body.mesh.is_part = true;
  std::vector<Vec3> before;
  for (Index v = 0; v < std::ssize(body.mesh.vertices); ++v) {
    Vertex& vertex = body.mesh.vertices[v];
    if (v % 2 == 0) vertex.mask |= kFrozen;
    before.push_back(vertex.position);
  }
  const Counters done = balance_skin(body.bench, {});
  EXPECT_GT(done.moves, 0);
  std::int64_t moved = 0;
  for (Index v = 0; v < std::ssize(body.mesh.vertices); ++v) {
    const Vertex& vertex = body.mesh.vertices[v];
    if (vertex.position == before[v]) continue;
    ++moved;
    EXPECT_EQ(v % 2, 1);
    EXPECT_LE(std::abs(kBall.distance(vertex.position)), FormulaShape::kTolerance);
  }
  EXPECT_EQ(moved, done.moves);
  expect_sound_body(body.mesh);
}

}  // namespace
}  // namespace mesamis
