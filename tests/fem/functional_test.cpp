// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/functional.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/fem/amis.h"
#include "mesamis/fem/mesh_space.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

class FunctionalOnAMesh : public ::testing::Test {
 protected:
  const TetMesh mesh_ = perturbed_box({{0, 0, 0}, {2, 3, 1}}, {4, 5, 3}, 0.2);
  const MeshSpace space_{mesh_};
  const AtParameters parameters_{0.2, 0.05, 1.7, 3.1};

  template <class Function>
  std::vector<double> nodal(Function&& function) const {
    std::vector<double> values;
    for (const Vec3& p : mesh_.points) values.push_back(function(p));
    return values;
  }
};

TEST_F(FunctionalOnAMesh, LinearFieldsHaveTheirClosedForm) {
  // u = 3x - y + 2z, f = u - 5, v = 1/2: each integral is a product with the volume 6.
  const auto u = nodal([](const Vec3& p) { return 3 * p.x - p.y + 2 * p.z; });
  const auto f = nodal([](const Vec3& p) { return 3 * p.x - p.y + 2 * p.z - 5; });
  const std::vector<double> v(u.size(), 0.5);
  const Energy e = energy(space_, parameters_, {u, v, f});
  EXPECT_NEAR(e.fidelity, 6 * 25, 1e-11);
  EXPECT_NEAR(e.smoothing, 6 * 1.7 * (0.25 + 0.05) * 14, 1e-11);
  EXPECT_NEAR(e.edge, 6 * 3.1 * 0.25 / (4 * 0.2), 1e-11);
  const auto ramp = nodal([](const Vec3& p) { return p.x; });
  const std::vector<double> zero(u.size(), 0);
  const double gradient_part =
      energy(space_, parameters_, {zero, ramp, zero}).edge - 3.1 / (4 * 0.2) * [&] {
        double sum = 0;
        for (std::size_t n = 0; n < ramp.size(); ++n) {
          sum += space_.lumped_mass()[n] * std::pow(ramp[n] - 1, 2);
        }
        return sum;
      }();
  EXPECT_NEAR(gradient_part, 3.1 * 0.2 * 6, 1e-11);
}

TEST_F(FunctionalOnAMesh, TheMinimisersMakeTheEnergyStationary) {
  // After the u-step the derivative in every direction of u vanishes, by finite differences.
  const auto f = nodal([](const Vec3& p) { return 100 * std::sin(2 * p.x) + 30 * p.y * p.z; });
  const std::vector<double> v_before(f.size(), 1);
  AmisOptions options;
  options.parameters = parameters_;
  options.max_iterations = 1;
  options.solver.tolerance = 1e-13;
  const AmisResult fields = run_amis(space_, f, {}, options);
  const double h = 1e-4;
  for (std::size_t n = 0; n < f.size(); n += 7) {
    auto u = fields.u;
    u[n] += h;
    const double up = energy(space_, parameters_, {u, v_before, f}).total();
    u[n] -= 2 * h;
    const double down = energy(space_, parameters_, {u, v_before, f}).total();
    EXPECT_NEAR((up - down) / (2 * h), 0, 1e-5);
    auto v = fields.v;
    v[n] += h;
    const double v_up = energy(space_, parameters_, {fields.u, v, f}).total();
    v[n] -= 2 * h;
    const double v_down = energy(space_, parameters_, {fields.u, v, f}).total();
    EXPECT_NEAR((v_up - v_down) / (2 * h), 0, 1e-4);
  }
}

}  // namespace
}  // namespace mesamis
