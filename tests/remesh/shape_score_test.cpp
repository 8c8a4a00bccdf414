// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/shape_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/mesh/element_quality.h"
#include "remesh/small_body.h"

namespace mesamis {
namespace {

const FormulaMetric kMetric = uniform_metric(0.25);
const PlaneShape kHalf({0, 0, 1}, 0.5, 1, kOutside);

/// A rule that one cell just keeps in one respect, and by far in the others.
struct OneRule {
  ElementShape shape;
  ShapeRule angle{}, greatest{}, jacobian{};

  explicit OneRule(const ElementShape& of) : shape(of) {
    const auto loose = [] {
      return ShapeRule{
          .least_angle = 1, .greatest_angle = 179.9, .scaled_jacobian = 0.01, .skin_angle = 0.1};
    };
    angle = greatest = jacobian = loose();
    angle.least_angle = shape.least_angle;
    greatest.greatest_angle = shape.greatest_angle;
    jacobian.scaled_jacobian = shape.scaled_jacobian;
  }
};

struct ScoredBody : SmallBody {
  ScoredBody() : SmallBody(perturbed_box(kUnitBox, {4, 4, 4}, 0.2), kMetric, kHalf) {}

  const Cell& points(Index c) const { return mesh.cells[c].points; }
  ElementShape shape(Index c) const {
    std::array<Vec3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.vertices[points(c)[i]].position;
    return element_shape(corners);
  }
};

TEST(ShapeScore, IsOneWhereARuleIsJustKept) {
  const ScoredBody body;
  for (Index c = 0; c < std::ssize(body.mesh.cells); ++c) {
    const OneRule rules(body.shape(c));
    for (const ShapeRule& rule : {rules.angle, rules.greatest, rules.jacobian}) {
      ASSERT_NEAR(shape_score(body.mesh, body.points(c), rule), 1, 1e-9);
    }
  }
}

/// Triangles in space are no triangles of a surface.
TEST(ShapeScore, TrianglesCountOnTheSkinAlone) {
  ScoredBody body;
  const ShapeRule rule{
      .least_angle = 1, .greatest_angle = 179.9, .scaled_jacobian = 1e-3, .skin_angle = 60};
  Index off_skin = kNoIndex, on_skin = kNoIndex;
  for (Index c = 0; c < std::ssize(body.mesh.cells); ++c) {
    const auto corners = std::ranges::count_if(
        body.points(c), [&](Index p) { return body.mesh.vertices[p].mask & kOnSkin; });
    if (corners < 3) off_skin = c;
    if (corners == 3) on_skin = c;
  }
  EXPECT_GE(shape_score(body.mesh, body.points(off_skin), rule), 1);
  EXPECT_LT(shape_score(body.mesh, body.points(on_skin), rule), 1);
}

TEST(ShapeScore, IsTheWorstOfAngleAndJacobian) {
  const ScoredBody body;
  const ElementShape shape = body.shape(0);
  const ShapeRule twice{.least_angle = 2 * shape.least_angle,
                        .greatest_angle = shape.greatest_angle,
                        .scaled_jacobian = shape.scaled_jacobian,
                        .skin_angle = 0.1};
  EXPECT_NEAR(shape_score(body.mesh, body.points(0), twice), 0.5, 1e-9);
}

TEST(WorstScoreInside, LeavesOutCellsOutside) {
  ScoredBody body;
  std::vector<Index> all, outside;
  double worst = INFINITY;
  for (Index c = 0; c < std::ssize(body.mesh.cells); ++c) {
    all.push_back(c);
    if (body.mesh.cells[c].material == kOutside) {
      outside.push_back(c);
    } else {
      worst = std::min(worst, shape_score(body.mesh, body.points(c), {}));
    }
  }
  EXPECT_EQ(worst_score_inside(body.mesh, all, {}), worst);
  EXPECT_EQ(worst_score_inside(body.mesh, outside, {}), INFINITY);
  EXPECT_LT(worst, INFINITY);
}

TEST(ArePositive, IsLostWithOneCellTurnedOver) {
  ScoredBody body;
  const Index middle = body.vertex_near({0.5, 0.5, 0.5});
  const std::vector<Index> ball = body.ball(middle);
  EXPECT_TRUE(are_positive(body.mesh, ball));
  body.mesh.vertices[middle].position = {0.5, 0.5, 3};
  EXPECT_FALSE(are_positive(body.mesh, ball));
}

TEST(SettleMoved, MeasuresTheCellsAroundAgainAndMarksThem) {
  ScoredBody body;
  const Index middle = body.vertex_near({0.5, 0.5, 0.5});
  const std::vector<Index> ball = body.ball(middle);
  for (const Index c : ball) body.mesh.cells[c].pending = 0;
  body.mesh.vertices[middle].position += Vec3{0.01, 0, 0.02};
  settle_moved(body.bench, middle, ball);
  for (const Index c : ball) {
    const WorkCell& cell = body.mesh.cells[c];
    EXPECT_FLOAT_EQ(cell.quality3, static_cast<float>(quality3(body.mesh, cell.points)));
    EXPECT_EQ(cell.pending, kToAll);
  }
}

}  // namespace
}  // namespace mesamis
