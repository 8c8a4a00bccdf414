// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/mid_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/finite_elements.h"
#include "mesamis/mesh/metric.h"
#include "support/body_shapes.h"
#include "support/metric_fields.h"

namespace mesamis {
namespace {

constexpr std::array<Vec3, 4> kCorners{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
constexpr Box kUnitBox{{0, 0, 0}, {1, 1, 1}};

std::array<Vec3, 6> straight_middles() {
  std::array<Vec3, 6> middles;
  for (std::size_t e = 0; e < 6; ++e) {
    middles[e] = 0.5 * (kCorners[static_cast<std::size_t>(kMidNodeEdges[e][0])] +
                        kCorners[static_cast<std::size_t>(kMidNodeEdges[e][1])]);
  }
  return middles;
}

BodyMesh ball_body(const RoundShape& shape, double size) {
  const FormulaMetric metric = uniform_metric(size);
  return remesh_body(remesh(coarse_box_mesh(kUnitBox), metric), metric, shape);
}

/// The volume of quadratic elements by the integration points of order two, exact enough for
/// elements that are bent little.
double quadratic_volume(const BodyMesh& body, const MidNodes& nodes) {
  double volume = 0;
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    const auto p = cell_corners(body.mesh, body.mesh.cells[c]);
    constexpr double kNear = 0.58541019662496852, kFar = 0.13819660112501052;
    for (std::size_t q = 0; q < 4; ++q) {
      std::array<double, 4> at{kFar, kFar, kFar, kFar};
      at[q] = kNear;
      std::array<Vec3, 4> d;
      for (std::size_t i = 0; i < 4; ++i) d[i] = (4 * at[i] - 1) * p[i];
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = kMidNodeEdges[e];
        const Vec3 m = nodes.points[nodes.of_cell[c][e]];
        d[static_cast<std::size_t>(i)] += 4 * at[static_cast<std::size_t>(j)] * m;
        d[static_cast<std::size_t>(j)] += 4 * at[static_cast<std::size_t>(i)] * m;
      }
      volume += dot(cross(d[1] - d[0], d[2] - d[0]), d[3] - d[0]) / 24;
    }
  }
  return volume;
}

TEST(MidNodes, JacobianOfStraightEdgesIsSixTimesTheVolume) {
  EXPECT_NEAR(least_jacobian(kCorners, straight_middles()), 1, 1e-14);
}

TEST(MidNodes, JacobianFallsWhereAnEdgeIsBentIn) {
  auto middles = straight_middles();
  middles[0] = {0.5, 0.3, 0.3};  // beyond where the element folds
  EXPECT_LT(least_jacobian(kCorners, middles), 0);
  middles[0] = {0.5, 0.05, 0.05};
  EXPECT_GT(least_jacobian(kCorners, middles), 0);
  EXPECT_LT(least_jacobian(kCorners, middles), 1);
}

TEST(MidNodes, EachEdgeHasOneInItsMiddleOrOnTheBorder) {
  const RoundShape ball({0.5, 0.5, 0.5}, 0.4);
  const BodyMesh body = ball_body(ball, 0.12);
  const MidNodes nodes = mid_nodes(body, ball, kUnitBox);
  std::vector<int> used(nodes.points.size(), 0);
  std::size_t on_border = 0;
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    for (std::size_t e = 0; e < 6; ++e) {
      const auto at = [&](int i) {
        return body.mesh.points[body.mesh.cells[c][static_cast<std::size_t>(i)]];
      };
      const Vec3 middle = 0.5 * (at(kMidNodeEdges[e][0]) + at(kMidNodeEdges[e][1]));
      const Vec3 node = nodes.points[nodes.of_cell[c][e]];
      used[nodes.of_cell[c][e]] = 1;
      const bool straight = norm(node - middle) < 1e-15;
      EXPECT_TRUE(straight || std::abs(ball.distance(node)) < 1e-12);
      on_border += !straight;
    }
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
  EXPECT_GT(on_border, 100U);
  EXPECT_EQ(nodes.straight, 0);
}

TEST(MidNodes, TheVolumeOfABallComesMuchNearer) {
  const RoundShape ball({0.5, 0.5, 0.5}, 0.4);
  const double exact = 4.0 / 3 * std::numbers::pi * 0.4 * 0.4 * 0.4;
  const BodyMesh body = ball_body(ball, 0.12);
  double linear = 0;
  for (Index c = 0; c < std::ssize(body.mesh.cells); ++c) linear += cell_volume(body.mesh, c);
  const double quadratic = quadratic_volume(body, mid_nodes(body, ball, kUnitBox));
  EXPECT_LT(std::abs(quadratic - exact), 0.1 * std::abs(linear - exact));
}

TEST(MidNodes, AnElementThatWouldFoldKeepsItsEdgesStraight) {
  // Of a ball so small that the nearest point lies far beyond the element.
  const RoundShape ball({0.1, 0.1, 0.1}, 0.01);
  const BodyMesh body{{{kCorners.begin(), kCorners.end()}, {{0, 1, 2, 3}}}, {1}, {}};
  const Box far{{-1, -1, -1}, {2, 2, 2}};
  const MidNodes nodes = mid_nodes(body, ball, far);
  EXPECT_EQ(nodes.straight, 6);
  const auto straight = straight_middles();
  for (std::size_t e = 0; e < 6; ++e) {
    EXPECT_EQ(nodes.points[nodes.of_cell[0][e]], straight[e]);
  }
}

TEST(MidNodes, WhatLiesInAPlaneOfTheBoxStaysThere) {
  const RoundShape cut({0.5, 0.5, 0}, 0.4);  // half a ball on the lower plane
  const BodyMesh body = ball_body(cut, 0.12);
  const MidNodes nodes = mid_nodes(body, cut, kUnitBox);
  std::size_t in_plane = 0;
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    for (std::size_t e = 0; e < 6; ++e) {
      const auto at = [&](int i) {
        return body.mesh.points[body.mesh.cells[c][static_cast<std::size_t>(i)]];
      };
      if (at(kMidNodeEdges[e][0]).z > 0 || at(kMidNodeEdges[e][1]).z > 0) continue;
      EXPECT_EQ(nodes.points[nodes.of_cell[c][e]].z, 0);
      ++in_plane;
    }
  }
  EXPECT_GT(in_plane, 50U);
}

TEST(MidNodes, AreTheSameForAnyNumberOfThreads) {
  const RoundShape ball({0.5, 0.5, 0.5}, 0.4);
  const BodyMesh body = ball_body(ball, 0.15);
  MidNodes one, four;
  with_threads(1, [&] { one = mid_nodes(body, ball, kUnitBox); });
  with_threads(4, [&] { four = mid_nodes(body, ball, kUnitBox); });
  EXPECT_EQ(one.points, four.points);
  EXPECT_EQ(one.of_cell, four.of_cell);
}

}  // namespace
}  // namespace mesamis
