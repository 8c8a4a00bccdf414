// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/ball_shape.h"

#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

double energy_at(SmallMesh& small, std::span<const Index> ball, Index v, const Vec3& position) {
  Vertex moved = small.mesh.vertices[v];
  moved.position = position;
  small.bench.shape.gather(small.mesh, ball, v);
  double sum = 0;
  for (const double q : small.bench.shape.qualities(moved)) sum += energy(q);
  return sum;
}

TEST(BallShape, QualitiesAreThoseOfTheCells) {
  const FormulaMetric metric = ugawg_metric(Ugawg::kPolar1, 0.5);
  SmallMesh small(perturbed_box(kUnitBox, {5, 5, 5}, 0.2), metric);
  for (Index v = 0; v < std::ssize(small.mesh.vertices); ++v) {
    const auto ball = small.bench.cavity.ball(v);
    small.bench.shape.gather(small.mesh, ball, v);
    Vertex& vertex = small.mesh.vertices[v];
    const Vertex old = vertex;
    vertex.position += Vec3{0.01, -0.02, 0.015};
    measure(vertex, small.sampler, vertex.hint);
    const auto qualities = small.bench.shape.qualities(vertex);
    ASSERT_EQ(qualities.size(), ball.size());
    for (std::size_t i = 0; i < ball.size(); ++i) {
      const double expected = quality3(small.mesh, small.mesh.cells[ball[i]].points);
      EXPECT_NEAR(qualities[i], expected, 1e-9 * expected);
    }
    vertex = old;
  }
}

TEST(BallShape, ACellTurnedInsideOutHasNoQuality) {
  const FormulaMetric metric = uniform_metric(0.5);
  SmallMesh small(box_mesh(kUnitBox, {2, 2, 2}), metric);
  for (Index v = 0; v < std::ssize(small.mesh.vertices); ++v) {
    if (small.mesh.vertices[v].mask != 0) continue;
    small.bench.shape.gather(small.mesh, small.bench.cavity.ball(v), v);
    Vertex outside = small.mesh.vertices[v];
    outside.position += Vec3{0.9, 0, 0};
    EXPECT_EQ(std::ranges::min(small.bench.shape.qualities(outside)), 0);
  }
}

TEST(BallShape, GradientIsTheEnergysDerivative) {
  const FormulaMetric metric([](const Vec3&) { return Sym3{9, 1, -2, 30, 0.5, 4}; });
  SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.2), metric);
  constexpr double kStep = 1e-5;
  for (Index v = 0; v < std::ssize(small.mesh.vertices); ++v) {
    const auto ball = small.bench.cavity.ball(v);
    small.bench.shape.gather(small.mesh, ball, v);
    const Vertex vertex = small.mesh.vertices[v];
    const Vec3 gradient = small.bench.shape.directions(vertex).gradient;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step;
      step[axis] = kStep;
      const double ahead = energy_at(small, ball, v, vertex.position + step);
      const double behind = energy_at(small, ball, v, vertex.position - step);
      EXPECT_NEAR(gradient[axis], (ahead - behind) / (2 * kStep), 1e-4 * norm(gradient) + 1e-4);
    }
  }
}

/// A cell that is regular in a metric of any axes has each corner where it should be.
TEST(BallShape, IdealPositionOfARegularCellIsItsCorner) {
  const FormulaMetric metric([](const Vec3&) { return Sym3{9, 1, -2, 30, 0.5, 4}; });
  const double s = std::sqrt(0.5);
  TetMesh regular{{{0, 0, 0}, {s, s, 0}, {s, 0, s}, {0, s, s}}, {{0, 1, 3, 2}}};
  Index hint = 0;
  const MetricFactor factor = MetricSampler(metric, kUnitBox).at({}, hint);
  for (Vec3& p : regular.points) p = out_of_metric(factor, p);
  ASSERT_GT(cell_volume(regular, 0), 0);
  SmallMesh small(regular, metric);
  EXPECT_NEAR(small.mesh.cells[0].quality3, 1, 1e-5);
  for (Index v = 0; v < 4; ++v) {
    small.bench.shape.gather(small.mesh, small.bench.cavity.ball(v), v);
    EXPECT_LT(norm(small.bench.shape.directions(small.mesh.vertices[v]).to_ideal), 1e-6);
  }
}

TEST(BallShape, SolvingUndoesTheMetric) {
  const MetricFactor l{3, 0.5F, -1, 2, 0.25F, 1.5F};
  const Vec3 v{0.3, -2, 1.1};
  EXPECT_LT(norm(out_of_metric(l, in_metric(l, v)) - v), 1e-12);
  EXPECT_LT(norm(solve_metric(l, from_metric(l, in_metric(l, v))) - v), 1e-12);
}

}  // namespace
}  // namespace mesamis
