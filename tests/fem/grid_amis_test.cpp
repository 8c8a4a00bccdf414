// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/grid_amis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {
namespace {

const KuhnGrid kGrid{{24, 22, 21}, {1, 0.8, 1.5}};

/// A bright ball with noise, grey values.
std::vector<float> noisy_ball() {
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0, 5);
  const Vec3 center = 0.5 * kGrid.box().extent();
  std::vector<float> f;
  for (const Vec3& p : box_mesh(kGrid.box(), {23, 21, 20}).points) {
    f.push_back(static_cast<float>((norm(p - center) < 6 ? 200 : 80) + noise(generator)));
  }
  return f;
}

AmisOptions options_with(double tolerance) {
  AmisOptions options;
  options.parameters.gamma = 0.3;
  options.max_iterations = 4;
  options.v_tolerance = 0;
  options.solver.tolerance = tolerance;
  return options;
}

AmisResult in_double(const std::vector<float>& f, const AmisOptions& options) {
  return run_amis(GridSpace(kGrid), std::vector<double>(f.begin(), f.end()), {}, options);
}

TEST(GridAmis, IsAlgorithm1InSinglePrecision) {
  const std::vector<float> f = noisy_ball();
  const AmisOptions options = options_with(1e-4);
  const GridMinimum found = run_amis_on_grid(kGrid, f, options);
  const AmisResult expected = in_double(f, options);
  EXPECT_EQ(found.report.iterations, expected.report.iterations);
  EXPECT_EQ(found.report.solver_iterations, expected.report.solver_iterations);
  EXPECT_TRUE(found.report.solver_converged);
  for (std::size_t n = 0; n < f.size(); ++n) {
    EXPECT_NEAR(found.u[n], expected.u[n], 1e-3);
    EXPECT_NEAR(found.v[n], expected.v[n], 1e-4);
  }
  const std::vector<double> exact(f.begin(), f.end());
  const Energy e = energy(GridSpace(kGrid), options.parameters, {expected.u, expected.v, exact});
  EXPECT_NEAR(found.energy.fidelity / e.fidelity, 1, 1e-5);
  EXPECT_NEAR(found.energy.smoothing / e.smoothing, 1, 1e-4);
  EXPECT_NEAR(found.energy.edge / e.edge, 1, 1e-4);
}

TEST(GridAmis, StopsWhenTheIndicatorHasSettled) {
  AmisOptions options = options_with(1e-4);
  options.max_iterations = 50;
  options.v_tolerance = 0.05;
  const GridMinimum found = run_amis_on_grid(kGrid, noisy_ball(), options);
  EXPECT_TRUE(found.report.converged);
  EXPECT_LT(found.report.iterations, 50);
  EXPECT_LE(found.report.v_change, 0.05);
}

TEST(GridAmis, LeavesToDoublePrecisionWhatIsTooExactOrTooStiff) {
  const std::vector<float> f = noisy_ball();
  AmisOptions exact = options_with(1e-8), stiff = options_with(1e-3);
  stiff.parameters.beta = 500;
  stiff.solver.jacobi_iterations = 5;
  for (const AmisOptions& options : {exact, stiff}) {
    const GridMinimum found = run_amis_on_grid(kGrid, f, options);
    const AmisResult expected = in_double(f, options);
    EXPECT_TRUE(found.report.solver_converged);
    EXPECT_EQ(found.report.solver_iterations, expected.report.solver_iterations);
    EXPECT_EQ(found.u, std::vector<float>(expected.u.begin(), expected.u.end()));
    EXPECT_EQ(found.v, std::vector<float>(expected.v.begin(), expected.v.end()));
  }
}

TEST(GridAmis, TheSameBitsForAnyNumberOfThreads) {
  const std::vector<float> f = noisy_ball();
  const auto run = [&] { return run_amis_on_grid(kGrid, f, options_with(1e-3)); };
  const GridMinimum a = with_threads(1, run), b = with_threads(4, run);
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.energy.total(), b.energy.total());
}

TEST(GridAmis, RefusesWhatItCannotUse) {
  const std::vector<float> few(kGrid.node_count() - 1, 1);
  EXPECT_THROW(run_amis_on_grid(kGrid, few, {}), InputError);
  AmisOptions none = options_with(1e-3);
  none.max_iterations = 0;
  EXPECT_THROW(run_amis_on_grid(kGrid, noisy_ball(), none), InputError);
  AmisOptions negative = options_with(1e-3);
  negative.parameters.beta = -1;
  EXPECT_THROW(run_amis_on_grid(kGrid, noisy_ball(), negative), InputError);
}

}  // namespace
}  // namespace mesamis
