// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/estimator.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesamis/adapt/metric_from_estimate.h"
#include "mesamis/adapt/size_control.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "support/oracle.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

constexpr double kAgree = 1e-6;
constexpr double kUnbounded = 3e4;  // stretch: the reference has no bound

std::vector<double> flatten(const std::vector<Sym3>& tensors, bool medit_order) {
  std::vector<double> values;
  for (const Sym3& m : tensors) {
    if (medit_order) {
      values.insert(values.end(), {m.xx, m.xy, m.yy, m.xz, m.yz, m.zz});
    } else {
      values.insert(values.end(), {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz});
    }
  }
  return values;
}

std::vector<double> flatten(const nlohmann::json& rows) {
  std::vector<double> values;
  for (const auto& row : rows) {
    for (const double value : row) values.push_back(value);
  }
  return values;
}

/// One oracle case: the fields after its last step and what was computed from them.
class EstimatorOracle : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    MESAMIS_REQUIRE_DATA(oracle_path());
    const auto oracle = read_oracle();
    case_ = oracle["cases"][GetParam()];
    mesh_ = oracle_mesh(oracle);
    const std::vector<double> f = oracle["f"];
    const std::vector<double> u = case_["steps"].back()["u"], v = case_["steps"].back()["v"];
    estimate_ = estimate(mesh_, oracle_parameters(case_), {u, v, f});
  }
  std::vector<Sym3> cell_metrics() const {
    std::vector<Sym3> metrics;
    for (const Sym3& gamma : estimate_.gamma) {
      metrics.push_back(
          cell_metric(gamma, {.cell_count = static_cast<std::int64_t>(mesh_.cells.size()),
                              .tau = case_["parameters"]["tau"],
                              .max_stretch = kUnbounded}));
    }
    return metrics;
  }
  nlohmann::json case_;
  TetMesh mesh_;
  Estimate estimate_;
};

TEST_P(EstimatorOracle, ResidualsAndEstimatorAgree) {
  const auto& sums = case_["residual_term_sums"];
  const char* a_names[] = {"e1", "e2", "e3", "e4", "e5"};
  const char* b_names[] = {"b1", "b2", "b3"};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(estimate_.sums.residuals.a[i] / sums[a_names[i]].get<double>(), 1, kAgree);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(estimate_.sums.residuals.b[i] / sums[b_names[i]].get<double>(), 1, kAgree);
  }
  EXPECT_NEAR(estimate_.sums.zeta_a / sums["zA"].get<double>(), 1, kAgree);
  EXPECT_NEAR(estimate_.sums.zeta_b / sums["zB"].get<double>(), 1, kAgree);
  EXPECT_NEAR(estimate_.sums.zeta() / case_["estimator_sum"].get<double>(), 1, kAgree);
  EXPECT_LT(relative_difference(estimate_.zeta, case_["cells"]["zeta"]), kAgree);
  EXPECT_LT(relative_difference(flatten(estimate_.gamma, false),
                                flatten(case_["cells"]["Gamma_xx_xy_xz_yy_yz_zz"])),
            kAgree);
}

TEST_P(EstimatorOracle, ShapesAgree) {
  std::vector<double> lambda, aspect;
  for (const Cell& k : mesh_.cells) {
    const CellShape shape = cell_shape(
        {mesh_.points[k[0]], mesh_.points[k[1]], mesh_.points[k[2]], mesh_.points[k[3]]});
    const auto s = aspect_ratios(shape);
    lambda.insert(lambda.end(), shape.lambda.begin(), shape.lambda.end());
    aspect.insert(aspect.end(), s.begin(), s.end());
  }
  EXPECT_LT(relative_difference(lambda, flatten(case_["cells"]["lambda_"])), 1e-9);
  EXPECT_LT(relative_difference(aspect, flatten(case_["cells"]["aspect"])), 1e-9);
}

TEST_P(EstimatorOracle, MetricAndPredictionAgree) {
  const auto metrics = cell_metrics();
  EXPECT_NEAR(predicted_cells(mesh_, metrics) / case_["predicted_cells"].get<double>(), 1, kAgree);
  EXPECT_LT(relative_difference(flatten(node_metrics(mesh_, metrics), true),
                                flatten(case_["node_metric_xx_xy_yy_xz_yz_zz"])),
            kAgree);
}

TEST_P(EstimatorOracle, ScaledMetricAgrees) {
  auto metrics = cell_metrics();
  const double goal = case_["scaled"]["NMAX"];
  const double scale = std::pow(goal / predicted_cells(mesh_, metrics), 2.0 / 3);
  for (Sym3& m : metrics) m = scale * m;
  EXPECT_NEAR(predicted_cells(mesh_, metrics) / goal, 1, 1e-9);
  EXPECT_LT(relative_difference(flatten(node_metrics(mesh_, metrics), true),
                                flatten(case_["scaled"]["node_metric_xx_xy_yy_xz_yz_zz"])),
            kAgree);
}

INSTANTIATE_TEST_SUITE_P(Cases, EstimatorOracle,
                         ::testing::Values("paper_parameters", "smooth_parameters"));

TEST(Estimator, LinearFieldsHaveNoRecoveredError) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 1}}, {4, 4, 4}, 0.2);
  std::vector<double> u, v;
  for (const Vec3& p : mesh.points) {
    u.push_back(10 + 3 * p.x - p.y);
    v.push_back(0.5 + 0.1 * p.z);
  }
  const Estimate e = estimate(mesh, {0.1, 0.01, 1, 1}, {u, v, u});
  for (const double zeta : e.zeta) EXPECT_NEAR(zeta, 0, 1e-5);
}

TEST(Estimator, TheSameBitsForAnyNumberOfThreads) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 1}}, {12, 12, 12}, 0.2);
  std::vector<double> u, v(mesh.points.size(), 0.5);
  for (const Vec3& p : mesh.points) u.push_back(std::sin(9 * p.x) * std::cos(7 * p.y + p.z));
  const Estimate a = with_threads(1, [&] { return estimate(mesh, {}, {u, v, u}); });
  const Estimate b = with_threads(3, [&] { return estimate(mesh, {}, {u, v, u}); });
  EXPECT_EQ(a.gamma, b.gamma);
  EXPECT_EQ(a.zeta, b.zeta);
  EXPECT_EQ(a.sums.zeta_a, b.sums.zeta_a);
}

TEST(Estimator, RefusesFieldsOfAnotherSize) {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {1, 1, 1});
  const std::vector<double> eight(8, 1), seven(7, 1);
  EXPECT_THROW(estimate(mesh, {}, {seven, eight, eight}), InputError);
  EXPECT_THROW(estimate(mesh, {}, {eight, eight, seven}), InputError);
}

}  // namespace
}  // namespace mesamis
