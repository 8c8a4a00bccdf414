// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/amis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/grid_space.h"
#include "mesamis/fem/mesh_space.h"
#include "support/oracle.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

AmisOptions accurate_options(const AtParameters& parameters) {
  AmisOptions options;
  options.parameters = parameters;
  options.v_tolerance = 0;
  options.solver.tolerance = 1e-13;
  return options;
}

/// A bright ball with noise, grey values.
std::vector<double> noisy_ball(const std::vector<Vec3>& points, const Vec3& center, double radius) {
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0, 5);
  std::vector<double> f;
  for (const Vec3& p : points) {
    f.push_back((norm(p - center) < radius ? 200 : 80) + noise(generator));
  }
  return f;
}

TEST(AmisOracle, HalfStepsAgree) {
  MESAMIS_REQUIRE_DATA(oracle_path());
  const auto oracle = read_oracle();
  const TetMesh mesh = oracle_mesh(oracle);
  const MeshSpace space(mesh);
  const std::vector<double> f = oracle["f"];
  for (const auto& [name, c] : oracle["cases"].items()) {
    SCOPED_TRACE(name);
    AmisOptions options = accurate_options(oracle_parameters(c));
    options.max_iterations = static_cast<int>(c["steps"].size());
    std::size_t half_step = 0;
    options.after_half_step = [&](std::span<const double> u, std::span<const double> v) {
      const auto& step = c["steps"][half_step / 2];
      const Energy e = energy(space, options.parameters, {u, v, f});
      if (half_step % 2 == 0) {
        EXPECT_LT(relative_difference({u.begin(), u.end()}, step["u"]), 1e-9);
        EXPECT_NEAR(e.total() / step["energy_after_u"].get<double>(), 1, 1e-9);
      } else {
        const auto& parts = step["energy_parts_after_v"];
        EXPECT_LT(relative_difference({v.begin(), v.end()}, step["v"]), 1e-9);
        EXPECT_NEAR(e.total() / step["energy_after_v"].get<double>(), 1, 1e-9);
        EXPECT_NEAR(e.fidelity / parts["fidelity"].get<double>(), 1, 1e-9);
        EXPECT_NEAR(e.smoothing / parts["smoothing"].get<double>(), 1, 1e-9);
        EXPECT_NEAR(e.edge / parts["edge"].get<double>(), 1, 1e-9);
      }
      ++half_step;
    };
    const AmisReport report = run_amis(space, f, {}, options).report;
    EXPECT_EQ(half_step, 2 * c["steps"].size());
    EXPECT_NEAR(report.v_change / c["steps"].back()["change_v_max"].get<double>(), 1, 1e-7);
  }
}

/// The laws that hold for every space.
void expect_descent(const P1Space& space, const std::vector<double>& f,
                    const AtParameters& parameters) {
  AmisOptions options = accurate_options(parameters);
  double last = 1e300;
  int half_steps = 0;
  options.after_half_step = [&](std::span<const double> u, std::span<const double> v) {
    const double now = energy(space, parameters, {u, v, f}).total();
    EXPECT_LE(now, last * (1 + 1e-12));
    last = now;
    ++half_steps;
  };
  run_amis(space, f, {}, options);
  EXPECT_EQ(half_steps, 20);
}

TEST(Amis, EnergyNeverRisesOnAMesh) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {9, 8, 7}}, {9, 8, 7}, 0.2);
  const MeshSpace space(mesh);
  const auto f = noisy_ball(mesh.points, {4.5, 4, 3.5}, 2.5);
  expect_descent(space, f, {});
  expect_descent(space, f, {0.3, 0.01, 0.05, 3.0});
}

TEST(Amis, EnergyNeverRisesOnAGrid) {
  const KuhnGrid grid{{10, 9, 8}, {1, 1, 1}};
  const auto f = noisy_ball(box_mesh(grid.box(), {9, 8, 7}).points, {4.5, 4, 3.5}, 2.5);
  expect_descent(GridSpace(grid), f, {});
  expect_descent(GridSpace(grid), f, {0.3, 0.01, 0.05, 3.0});
}

TEST(Amis, EdgeIndicatorStaysInRangeOnAGrid) {
  // Prop. 2.1 carries over: the stencil is an M-matrix, so nothing needs to be clamped.
  const KuhnGrid grid{{12, 12, 12}, {1, 0.5, 2}};
  const auto f = noisy_ball(box_mesh(grid.box(), {11, 11, 11}).points, {5, 3, 10}, 3);
  for (const AtParameters& parameters : {AtParameters{}, AtParameters{0.5, 0.01, 1, 10}}) {
    const AmisResult fields = run_amis(GridSpace(grid), f, {}, accurate_options(parameters));
    EXPECT_EQ(fields.report.clamped, 0u);
    EXPECT_THAT(fields.v, ::testing::Each(::testing::AllOf(::testing::Ge(0), ::testing::Le(1))));
  }
}

TEST(Amis, AConstantImageHasNoEdge) {
  const KuhnGrid grid{{5, 6, 7}, {1, 1, 1}};
  const std::vector<double> f(grid.node_count(), 42);
  AmisOptions options;
  options.solver.tolerance = 1e-8;
  const AmisResult fields = run_amis(GridSpace(grid), f, {}, options);
  EXPECT_TRUE(fields.report.converged);
  for (std::size_t n = 0; n < f.size(); ++n) {
    EXPECT_NEAR(fields.u[n], 42, 1e-5);
    EXPECT_NEAR(fields.v[n], 1, 1e-7);
  }
}

TEST(Amis, MeshAndGridAgreeOnKuhnCells) {
  const KuhnGrid grid{{8, 7, 6}, {1, 0.7, 1.5}};
  const TetMesh mesh = box_mesh(grid.box(), {7, 6, 5});
  const auto f = noisy_ball(mesh.points, {3.5, 2, 3.7}, 1.8);
  const AmisOptions options = accurate_options({0.2, 0.01, 0.5, 5});
  const AmisResult a = run_amis(MeshSpace(mesh), f, {}, options);
  const AmisResult b = run_amis(GridSpace(grid), f, {}, options);
  EXPECT_LT(relative_difference(a.u, b.u), 1e-9);
  EXPECT_LT(relative_difference(a.v, b.v), 1e-9);
}

TEST(Amis, StartsFromAnIndicatorOfOneIfNoneIsGiven) {
  const KuhnGrid grid{{8, 7, 6}, {1, 0.7, 1.5}};
  const auto f = noisy_ball(box_mesh(grid.box(), {7, 6, 5}).points, {3.5, 2, 3.7}, 1.8);
  const AmisResult none = run_amis(GridSpace(grid), f, {}, {});
  const AmisResult one = run_amis(GridSpace(grid), f, {std::vector<double>(f.size(), 1), f}, {});
  EXPECT_EQ(none.u, one.u);
  EXPECT_EQ(none.v, one.v);
}

TEST(Amis, TheSameBitsForAnyNumberOfThreads) {
  const KuhnGrid grid{{33, 31, 29}, {1, 1, 1}};
  const auto f = noisy_ball(box_mesh(grid.box(), {32, 30, 28}).points, {16, 15, 14}, 9);
  const AmisResult a = with_threads(1, [&] { return run_amis(GridSpace(grid), f, {}, {}); });
  const AmisResult b = with_threads(4, [&] { return run_amis(GridSpace(grid), f, {}, {}); });
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.v, b.v);
}

TEST(Amis, RefusesWhatItCannotUse) {
  const GridSpace space({{3, 3, 3}, {1, 1, 1}});
  const std::vector<double> f(27, 1), few(26, 1);
  EXPECT_THROW(run_amis(space, few, {}, {}), InputError);
  EXPECT_THROW(run_amis(space, f, {.v = few}, {}), InputError);
  EXPECT_THROW(run_amis(space, f, {.u = few}, {}), InputError);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    AmisOptions options;
    options.parameters.beta = bad;
    EXPECT_THROW(run_amis(space, f, {}, options), InputError);
  }
}

}  // namespace
}  // namespace mesamis
