// SPDX-License-Identifier: Apache-2.0
// The whole way from grey values to bins, beside Bonemat's rule written down naively.
#include "mesamis/body/materials.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "mesamis/base/parallel.h"
#include "support/perturbed_box.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A shaft in HU: a cortex of 1300 around a marrow of 200 in tissue of 50, as blurred as scans are.
Volume shaft() {
  return sampled_volume({33, 33, 17}, {0.8, 0.8, 1.5}, [](const Vec3& p) {
    const double r = std::hypot(p.x - 12.8, p.y - 12.8);
    const double outer = 1 / (1 + std::exp((r - 10) / 0.6));
    const double inner = 1 / (1 + std::exp((r - 6) / 0.9));
    return 50 + 1250 * outer - 1100 * inner + 10 * p.z;
  });
}

TetMesh shaft_mesh() { return perturbed_box({{2, 2, 1}, {23, 23, 22}}, {9, 9, 6}, 0.2); }

MaterialOptions morgan() {
  MaterialOptions options;
  options.law = find_material_law("morgan-2003-pooled");
  options.calibration = parse_calibration("0:0,1000:0.8");
  return options;
}

// ------------------------------------------------- Bonemat's rule, by hand

double naive_trilinear(const Volume& v, const Vec3& p) {
  double sum = 0;
  const std::array<double, 3> x{p.x / v.spacing.x, p.y / v.spacing.y, p.z / v.spacing.z};
  for (Index k = 0; k < v.size[2]; ++k) {
    const double wz = 1 - std::abs(x[2] - k);
    if (wz <= 0) continue;
    for (Index j = 0; j < v.size[1]; ++j) {
      const double wy = 1 - std::abs(x[1] - j);
      if (wy <= 0) continue;
      for (Index i = static_cast<Index>(x[0]); i <= static_cast<Index>(x[0]) + 1; ++i) {
        sum += std::max(0.0, 1 - std::abs(x[0] - i)) * wy * wz * v.at(i, j, k);
      }
    }
  }
  return sum;
}

/// Morgan's pooled law with the ash density of Schileo.
double naive_modulus(double hu) {
  const double qct = 0.0008 * hu;
  const double app = std::max(0.0, (0.877 * qct + 0.079) / 0.6);
  return 8920 * std::pow(app, 1.83);
}

/// Points of the unit cube in equal steps; sorted, the gaps between their coordinates are spread
/// evenly over a cell.
double naive_mean(const Volume& volume, const std::array<Vec3, 4>& p) {
  constexpr int kSteps = 20;
  double sum = 0;
  for (int n = 0; n < kSteps * kSteps * kSteps; ++n) {
    std::array<double, 3> x{(n % kSteps + 0.5) / kSteps, (n / kSteps % kSteps + 0.5) / kSteps,
                            (n / kSteps / kSteps + 0.5) / kSteps};
    std::sort(x.begin(), x.end());
    const Vec3 at = x[0] * p[0] + (x[1] - x[0]) * p[1] + (x[2] - x[1]) * p[2] + (1 - x[2]) * p[3];
    sum += naive_modulus(naive_trilinear(volume, at));
  }
  return sum / (kSteps * kSteps * kSteps);
}

/// Takes the stiffest element that is left and all within the gap, until none is left.
std::vector<double> naive_bins(const std::vector<double>& modulus, double gap) {
  std::vector<double> result(modulus.size(), -1);
  while (true) {
    double top = -1;
    for (std::size_t c = 0; c < modulus.size(); ++c) {
      if (result[c] < 0) top = std::max(top, modulus[c]);
    }
    if (top < 0) return result;
    for (std::size_t c = 0; c < modulus.size(); ++c) {
      if (result[c] < 0 && modulus[c] >= top - gap) result[c] = top;
    }
  }
}

TEST(Materials, AgreeWithBonematsRuleWrittenNaively) {
  const Volume volume = shaft();
  const TetMesh mesh = shaft_mesh();
  MaterialOptions options = morgan();
  options.gap = 100;
  const Materials found = assign_materials(mesh, volume, options);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double expected = naive_mean(volume, cell_corners(mesh, mesh.cells[c]));
    EXPECT_NEAR(found.modulus[c], expected, 0.01 * expected) << c;
  }
  const std::vector<double> naive = naive_bins(found.modulus, 100);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto bin = static_cast<std::size_t>(found.bins.of_cell[c]);
    EXPECT_EQ(found.bins.bins[bin].modulus, naive[c]);
  }
}

TEST(Materials, SayWhatWasUsed) {
  MaterialOptions options = morgan();
  options.density_max = 1.5;
  const Materials found = assign_materials(shaft_mesh(), shaft(), options);
  const MaterialReport& report = found.report;
  EXPECT_EQ(report.law, "morgan-2003-pooled");
  EXPECT_THAT(report.citation, HasSubstr("J Biomech 36, 2003"));
  EXPECT_EQ(report.doi, "10.1016/s0021-9290(03)00071-x");
  EXPECT_EQ(report.density, DensityKind::kApparent);
  EXPECT_NEAR(report.calibration.at(1000), (0.877 * 0.8 + 0.079) / 0.6, 1e-12);
  EXPECT_EQ(report.share_below_min, 0);
  EXPECT_GT(report.share_above_max, 0);
  EXPECT_GT(report.share_outside_law.value(), report.share_above_max);
  EXPECT_EQ(found.bins.bins[0].poisson, 0.3);
  options.poisson = 0.35;
  options.law = find_material_law("keyak-1994");
  const Materials keyak = assign_materials(shaft_mesh(), shaft(), options);
  EXPECT_EQ(keyak.report.density, DensityKind::kAsh);
  EXPECT_FALSE(keyak.report.share_outside_law) << "no range is known, so none is told";
  EXPECT_EQ(keyak.bins.bins[0].poisson, 0.35);
}

TEST(Materials, OfAUniformScanAreOne) {
  const Volume volume = sampled_volume({5, 5, 5}, {1, 1, 1}, [](const Vec3&) { return 400; });
  const Materials found =
      assign_materials(box_mesh({{0, 0, 0}, {4, 4, 4}}, {2, 2, 2}), volume, morgan());
  ASSERT_EQ(found.bins.bins.size(), 1u);
  EXPECT_NEAR(found.bins.bins[0].modulus, naive_modulus(400), 1e-6);
  EXPECT_NEAR(found.bins.bins[0].density, (0.877 * 0.32 + 0.079) / 0.6, 1e-9);
  EXPECT_EQ(found.bins.bins[0].cells, 48);
}

/// Whatever density a law takes, the mass of a solver is the apparent density.
TEST(Materials, OfASolverHaveTheApparentDensity) {
  const Volume volume = sampled_volume({5, 5, 5}, {1, 1, 1}, [](const Vec3&) { return 400; });
  const TetMesh mesh = box_mesh({{0, 0, 0}, {4, 4, 4}}, {2, 2, 2});
  MaterialOptions options = morgan();
  for (const char* law : {"E=100*rho_app^2", "E=100*rho_ash^2", "E=100*rho_qct^2"}) {
    options.law = parse_material_law(law);
    const Materials found = assign_materials(mesh, volume, options);
    const auto materials = elastic_materials(found, options);
    ASSERT_EQ(materials.size(), 1u);
    EXPECT_EQ(materials[0].name, "MAT_001");
    EXPECT_EQ(materials[0].modulus, found.bins.bins[0].modulus);
    EXPECT_EQ(materials[0].poisson, 0.3);
    EXPECT_NEAR(materials[0].density, (0.877 * 0.32 + 0.079) / 0.6, 1e-9) << law;
  }
  Materials many;
  many.bins.bins.resize(1234);
  EXPECT_EQ(elastic_materials(many, options)[0].name, "MAT_0001");
  EXPECT_EQ(elastic_materials(many, options)[1233].name, "MAT_1234");
}

TEST(Materials, HaveTheSameBitsForAnyNumberOfThreads) {
  const Volume volume = shaft();
  const TetMesh mesh = shaft_mesh();
  const auto run = [&] { return assign_materials(mesh, volume, morgan()); };
  const Materials one = with_threads(1, run), two = with_threads(2, run);
  EXPECT_EQ(one.modulus, two.modulus);
  EXPECT_EQ(one.bins.of_cell, two.bins.of_cell);
  EXPECT_EQ(one.report.share_outside_law, two.report.share_outside_law);
}

TEST(Materials, AskForALawAndACalibration) {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {4, 4, 4}}, {1, 1, 1});
  Volume volume = sampled_volume({5, 5, 5}, {1, 1, 1}, [](const Vec3& p) { return 100 * p.x; });
  MaterialOptions options = morgan();
  options.calibration.reset();
  EXPECT_REFUSED(assign_materials(mesh, volume, options),
                 AllOf(HasSubstr("HU1:rho1,HU2:rho2"), HasSubstr("values are not HU")));
  volume.modality = "CT";
  EXPECT_REFUSED(assign_materials(mesh, volume, options), HasSubstr("for a scan in HU"));
  options = morgan();
  options.law.reset();
  EXPECT_REFUSED(assign_materials(mesh, volume, options), HasSubstr("law of stiffness"));
}

}  // namespace
}  // namespace mesamis
