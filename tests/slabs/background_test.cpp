// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/background.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesamis/base/sym3.h"
#include "support/metric_fields.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

const Box kBox{{0, 0, 0}, {4, 4, 8}};

double linear(const Vec3& p) { return 1 + 2 * p.x - p.y + 0.5 * p.z; }
double other_linear(const Vec3& p) { return 3 - p.x + p.z; }
/// Linear in its logarithm: interpolated without an error.
Sym3 metric_at(const Vec3& p, double scale) { return scale * std::exp(0.1 * p.z) * kIdentity3; }

Piece mesh_piece(double scale) {
  Piece piece{perturbed_box(kBox, {4, 4, 8}, 0.2), {}};
  for (const Vec3& p : piece.mesh.points) {
    piece.nodes.push_back({scale * linear(p), other_linear(p), 5, metric_at(p, scale)});
  }
  return piece;
}

GridWindow grid_window(double scale) {
  GridWindow window{kBox, {5, 5, 9}, {}, {}, {}};
  for (Index k = 0; k < 9; ++k) {
    for (Index j = 0; j < 5; ++j) {
      for (Index i = 0; i < 5; ++i) {
        const Vec3 p{1.0 * i, 1.0 * j, 1.0 * k};
        window.u.push_back(static_cast<float>(scale * linear(p)));
        window.v.push_back(static_cast<float>(other_linear(p)));
        const auto log = static_cast<float>(std::log(scale) + 0.1 * p.z);
        window.log_metrics.push_back({log, 0, 0, log, 0, log});
      }
    }
  }
  return window;
}

std::vector<Vec3> random_points(double low = 0, double high = 8) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> across(0, 4), up(low, high);
  std::vector<Vec3> points;
  for (int n = 0; n < 200; ++n)
    points.push_back({across(generator), across(generator), up(generator)});
  return points;
}

void expect_exact(const Background& background, const std::vector<Vec3>& points, double scale,
                  double tolerance) {
  const std::vector<NodeValues> values = background.values(points);
  ASSERT_EQ(values.size(), points.size());
  Index hint = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    EXPECT_NEAR(values[n].u, scale * linear(points[n]), scale * tolerance);
    EXPECT_NEAR(values[n].v, other_linear(points[n]), tolerance);
    EXPECT_EQ(values[n].f, 0);
    const double expected = metric_at(points[n], scale).yy;
    EXPECT_NEAR(values[n].metric.yy / expected, 1, tolerance);
    EXPECT_NEAR(background.at(points[n], hint).yy / expected, 1, tolerance);
  }
}

TEST(MeshBackground, LinearFieldsAreExact) {
  expect_exact(MeshBackground(mesh_piece(2)), random_points(), 2, 1e-9);
}

TEST(GridBackground, LinearFieldsAreExact) {
  expect_exact(GridBackground(grid_window(2)), random_points(), 2, 1e-5);
}

TEST(LowBackground, OnlyWhatIsTooHighIsLowered) {
  // Sizes of the metric fall from 1 to 0.67 with height; edges along z are to have 0.8 at most.
  const GridBackground inner(grid_window(1));
  const LowBackground low(inner, 1, 0.8);
  const std::vector<Vec3> points = random_points();
  const std::vector<NodeValues> before = inner.values(points), after = low.values(points);
  int lowered = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    Index hint = 0;
    EXPECT_EQ(low.at(points[n], hint), after[n].metric);
    EXPECT_EQ(after[n].u, before[n].u);
    EXPECT_EQ(after[n].v, before[n].v);
    const Sym3 &was = before[n].metric, &is = after[n].metric;
    EXPECT_NEAR(is.xx, was.xx, 1e-12);
    EXPECT_NEAR(is.yy, was.yy, 1e-12);
    EXPECT_NEAR(1 / std::sqrt(is.zz), std::min(0.8, 1 / std::sqrt(was.zz)), 1e-12);
    if (is.zz > 1.01 * was.zz) ++lowered;
  }
  EXPECT_GT(lowered, 40);
  EXPECT_LT(lowered, 160);
}

TEST(LowBackground, NoUnitEdgeOfATiltedMetricIsHigher) {
  // Unit edges reach up by the root of the inverse's zz.
  const auto height = [](const Sym3& m) { return std::sqrt(inverse(m).zz); };
  const double tilt = std::sqrt(0.5);
  const Sym3 tilted =
      compose({1, 16, 4}, {Vec3{tilt, 0, tilt}, Vec3{tilt, 0, -tilt}, Vec3{0, 1, 0}});
  Piece piece = mesh_piece(1);
  for (NodeValues& node : piece.nodes) node.metric = tilted;
  const MeshBackground inner(std::move(piece));
  ASSERT_GT(height(tilted), 0.7);
  for (const double highest : {0.2, 0.5, 2.0}) {
    const LowBackground low(inner, 1, highest);
    Index hint = 0;
    const Sym3 metric = low.at({2, 2, 4}, hint);
    EXPECT_LE(height(metric), std::min(highest, height(tilted)) + 1e-9);
    if (highest > 1) {
      EXPECT_NEAR(metric.xz, tilted.xz, 1e-9) << "nothing is to be lowered";
    }
  }
}

TEST(GridWindow, SomeSlicesKeepTheirPlaceAndValues) {
  const GridWindow some = slices_between(grid_window(1), 2.5, 4.2);
  EXPECT_EQ(some.box.lo.z, 2);
  EXPECT_EQ(some.box.hi.z, 5);
  EXPECT_EQ(some.size, (std::array<Index, 3>{5, 5, 4}));
  EXPECT_EQ(some.u.size(), 100U);
  expect_exact(GridBackground(some), random_points(2, 5), 1, 1e-5);
}

TEST(GridWindow, HasTwoSlicesAtLeast) {
  for (const double height : {-3.0, 0.0, 3.0, 8.0, 12.0}) {
    const GridWindow some = slices_between(grid_window(1), height, height);
    EXPECT_EQ(some.size[2], 2) << height;
    expect_exact(GridBackground(some), random_points(some.box.lo.z, some.box.hi.z), 1, 1e-5);
  }
  EXPECT_EQ(slices_between(grid_window(1), -5, 50).u, grid_window(1).u);
}

std::unique_ptr<MeshBackground> mesh_background(double scale) {
  return std::make_unique<MeshBackground>(mesh_piece(scale));
}

TEST(StackedBackground, TakesTheValuesOfEachPart) {
  std::vector<std::unique_ptr<Background>> parts;
  for (const double scale : {1, 10, 100}) parts.push_back(mesh_background(scale));
  const StackedBackground all(std::move(parts), {4, 6});
  const auto scale_at = [](const Vec3& p) { return p.z < 4 ? 1.0 : p.z < 6 ? 10.0 : 100.0; };
  expect_exact(all, random_points(0, 3.99), 1, 1e-9);
  expect_exact(all, random_points(4, 5.99), 10, 1e-9);
  expect_exact(all, random_points(6, 8), 100, 1e-9);
  // One hint for places of all parts, in turns.
  Index hint = 0;
  for (const Vec3& p : random_points()) {
    EXPECT_NEAR(all.at(p, hint).xx / metric_at(p, scale_at(p)).xx, 1, 1e-9);
  }
  const std::vector<Vec3> mixed = random_points();
  const std::vector<NodeValues> values = all.values(mixed);
  for (std::size_t n = 0; n < mixed.size(); ++n) {
    EXPECT_NEAR(values[n].u, scale_at(mixed[n]) * linear(mixed[n]), 1e-7);
  }
  EXPECT_EQ(all.values({}).size(), 0U);
}

TEST(StackedBackground, OfWindowsIsThatOfTheWhole) {
  const GridWindow whole = grid_window(2);
  const auto all = stack(
      {slices_between(whole, 0, 2), slices_between(whole, 2, 5), slices_between(whole, 5, 8)});
  expect_exact(*all, random_points(), 2, 1e-5);
}

}  // namespace
}  // namespace mesamis
