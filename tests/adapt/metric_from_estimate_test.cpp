// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/metric_from_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesamis/adapt/cell_shape.h"
#include "mesamis/adapt/estimator.h"
#include "mesamis/base/error.h"
#include "mesamis/base/sym3.h"

namespace mesamis {
namespace {

constexpr double kUnbounded = 3e4;  // stretch: far beyond that of any Gamma here

TEST(CellMetric, HasTheSizesOfProposition32) {
  const Sym3 gamma{5, 1, 0.5, 3, -0.2, 2};
  const SymEigen g = eigen_decompose(gamma);
  const double tau = 0.03;
  const double tets = 1000;
  const SymEigen m = eigen_decompose(cell_metric(gamma, {1000, tau, kUnbounded}));
  const double factor = std::pow(tau / (std::sqrt(3.0) * kReferenceVolume * tets), 0.25) *
                        std::pow(g.values[0] * g.values[1] * g.values[2], 0.125);
  for (std::size_t i = 0; i < 3; ++i) {
    const double lambda = factor / std::sqrt(g.values[2 - i]);  // the largest size first
    EXPECT_NEAR(1 / std::sqrt(m.values[2 - i]) / lambda, 1, 1e-7);
    EXPECT_NEAR(std::abs(dot(m.vectors[2 - i], g.vectors[2 - i])), 1, 1e-7);
  }
}

TEST(CellMetric, FlatFieldsGiveAFiniteMetric) {
  EXPECT_EQ(cell_metric({}, {10, 0.01, kUnbounded}), Sym3{});
  for (const double scale : {1e-200, 1.0, 1e200}) {
    const Sym3 m = cell_metric({scale, 0, 0, 0, 0, 0}, {10, 0.01, kUnbounded});
    EXPECT_TRUE(std::isfinite(m.xx) && std::isfinite(m.yy));
    EXPECT_GT(m.xx, m.yy);
    EXPECT_GT(m.yy, 0);
  }
}

TEST(CellMetric, FieldsThatAreNearlyFlatGiveAFiniteMetric) {
  // From the least positive number on: below 2.2e-308 numbers are denormal.
  for (double size = std::numeric_limits<double>::denorm_min(); size < 1e-290; size *= 8) {
    const Sym3 m = cell_metric({size, 0, 0, 0, 0, 0}, {10, 0.01, kUnbounded});
    EXPECT_TRUE(std::isfinite(m.xx) && std::isfinite(m.xy) && std::isfinite(m.yy)) << size;
    EXPECT_GE(m.xx, 0);
  }
}

/// Far from an edge without noise u fades out to denormal numbers; the estimate is of its fourth
/// power.
TEST(CellMetric, IsFiniteWhereTheImageFadesOut) {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {3, 3, 3}}, {3, 3, 3});
  const std::size_t n = mesh.points.size();
  std::vector<double> u(n), v(n, 1), f(n, 0);
  bool denormal = false;
  for (double scale = 1e-70; scale > 1e-90; scale /= 3) {
    for (std::size_t i = 0; i < n; ++i) u[i] = scale * mesh.points[i].x * mesh.points[i].x;
    const Estimate e = estimate(mesh, {}, {u, v, f});
    for (const Sym3& gamma : e.gamma) {
      const Sym3 m = cell_metric(gamma, {static_cast<std::int64_t>(e.gamma.size()), 0.01, 10});
      EXPECT_TRUE(std::isfinite(trace(m)) && std::isfinite(determinant(m))) << scale;
      denormal |= std::fpclassify(trace(gamma)) == FP_SUBNORMAL;
    }
  }
  EXPECT_TRUE(denormal) << "the test must meet such a cell";
}

TEST(CellMetric, StretchIsBounded) {
  // A field that varies along x alone: sizes along y and z would be endless.
  for (const double stretch : {10.0, 100.0}) {
    const SymEigen m = eigen_decompose(
        cell_metric({7, 0, 0, 0, 0, 0}, {.cell_count = 10, .tau = 0.01, .max_stretch = stretch}));
    EXPECT_NEAR(std::sqrt(m.values[0] / m.values[2]) / stretch, 1, 0.01);
  }
}

TEST(NodeMetrics, ACellInItsOwnUnitSphereGetsUnitEdges) {
  // The regular tetrahedron inscribed in the unit sphere, metric I: edges sqrt(8/3) times
  // sqrt(3/8) are one.
  TetMesh mesh;
  const double s = std::sqrt(8.0 / 9), t = std::sqrt(2.0 / 9), w = std::sqrt(2.0 / 3);
  mesh.points = {{s, 0, -1.0 / 3}, {-t, w, -1.0 / 3}, {-t, -w, -1.0 / 3}, {0, 0, 1}};
  mesh.cells = {{0, 1, 2, 3}};
  const auto metrics = node_metrics(mesh, std::vector<Sym3>{kIdentity3});
  for (const auto& [i, j] : kCellEdges) {
    EXPECT_NEAR(quadratic_form(metrics[i], mesh.points[j] - mesh.points[i]), 1, 1e-12);
  }
  EXPECT_NEAR(predicted_cells(mesh, std::vector<Sym3>{kIdentity3}), 1, 1e-12);
}

TEST(NodeMetrics, RefusesAnotherNumberOfCells) {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {1, 1, 1});
  EXPECT_THROW(node_metrics(mesh, std::vector<Sym3>(5)), InputError);
  EXPECT_THROW(predicted_cells(mesh, std::vector<Sym3>(7)), InputError);
}

}  // namespace
}  // namespace mesamis
