// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/element_moduli.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "mesamis/base/parallel.h"
#include "support/perturbed_box.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Native values are the density in mg/cm^3.
ElementModuliOptions milligrams(const char* law) {
  ElementModuliOptions options;
  options.law = parse_material_law(law);
  options.calibration = {0, 0.001};
  return options;
}

TEST(ElementModuli, OfAUniformScanAreTheLawsOwn) {
  const Volume volume = sampled_volume({9, 9, 9}, {1, 1, 1}, [](const Vec3&) { return 500; });
  const TetMesh mesh = perturbed_box({{0.5, 1, 1.5}, {7, 7, 7}}, {3, 4, 3}, 0.3);
  const ElementModuli found = element_moduli(mesh, volume, milligrams("morgan-2003-femoral-neck"));
  ASSERT_EQ(found.modulus.size(), mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    EXPECT_NEAR(found.modulus[c], 6850 * std::pow(0.5, 1.49), 1e-8);
    EXPECT_NEAR(found.density[c], 0.5, 1e-12);
  }
  EXPECT_EQ(found.share_below_min, 0);
  EXPECT_EQ(found.share_above_max, 0);
  EXPECT_EQ(found.share_outside_law, 0);
  EXPECT_EQ(found.share_of_modulus_min, 0);
}

/// Of a linear function the mean over a cell is its value at the centroid; on a grid that is turned
/// and shifted, of cells far larger and far smaller than a voxel.
TEST(ElementModuli, OfALinearScanAndALinearLawAreExact) {
  Volume volume = sampled_volume({20, 16, 30}, {0.5, 0.7, 0.4}, [](const Vec3& p) {
    return 300 + 20 * p.x + 15 * p.y + 12 * p.z;
  });
  volume.origin = {-11, 7, 100};
  const double c = std::cos(0.4), s = std::sin(0.4);
  volume.direction = {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
  for (const Index bricks : {1, 3, 30}) {
    TetMesh mesh = perturbed_box({{0, 0, 0}, {9.5, 10.5, 11.6}}, {bricks, 2, bricks}, 0.2);
    std::vector<double> expected;
    for (const Cell& cell : mesh.cells) {
      Vec3 centre;
      for (const Vec3& p : cell_corners(mesh, cell)) centre += 0.25 * p;
      expected.push_back(0.3 + 0.02 * centre.x + 0.015 * centre.y + 0.012 * centre.z);
    }
    for (Vec3& p : mesh.points) p = volume.to_world(p);
    const ElementModuli found = element_moduli(mesh, volume, milligrams("E=1000*rho^1"));
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(found.density[k], expected[k], 1e-6);  // samples are single precision
      EXPECT_NEAR(found.modulus[k], 1000 * expected[k], 1e-3);
    }
  }
}

/// E is averaged, not the density: of two halves of 0.2 and 0.8 g/cm^3 under rho^3 the mean is
/// (0.2^3 + 0.8^3) / 2, not 0.5^3. Voxels are small, so that the slope between the halves is.
TEST(ElementModuli, AverageTheModulusNotTheDensity) {
  const Volume volume = sampled_volume({201, 5, 5}, {0.05, 2.5, 2.5}, [](const Vec3& p) {
    return p.x < 4.99 ? 200 : p.x > 5.01 ? 800 : 500;
  });
  const TetMesh mesh = box_mesh({{0, 0, 0}, {10, 10, 10}}, {1, 1, 1});
  ElementModuliOptions options = milligrams("E=1000*rho^3");
  const ElementModuli found = element_moduli(mesh, volume, options);
  double modulus = 0;  // the six cells are of equal volume
  for (const double e : found.modulus) modulus += e / 6;
  EXPECT_NEAR(modulus, 1000 * (0.008 + 0.512) / 2, 3);
}

/// The sum of E times volume over a box of side 10 in which the density is x / 10, divided by the
/// volume of the box: for c rho^p it is c / (p + 1) MPa.
double mean_over_box(const char* law, double parts_per_voxel) {
  const Volume volume =
      sampled_volume({11, 11, 11}, {1, 1, 1}, [](const Vec3& p) { return 100 * p.x; });
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {10, 10, 10}}, {2, 2, 2}, 0.3);
  ElementModuliOptions options = milligrams(law);
  options.parts_per_voxel = parts_per_voxel;
  const ElementModuli found = element_moduli(mesh, volume, options);
  double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    sum += found.modulus[c] * cell_volume(mesh, static_cast<Index>(c)) / 1000;
  }
  return sum;
}

TEST(ElementModuli, IntegrateDegreeTwoExactly) {
  for (const double parts : {0.1, 0.5, 1.0}) {
    EXPECT_NEAR(mean_over_box("E=900*rho^2", parts), 300, 1e-9);
    EXPECT_NEAR(mean_over_box("E=900*rho^1", parts), 450, 1e-9);
  }
}

TEST(ElementModuli, ConvergeToTheIntegralOfAPowerLaw) {
  double coarse = 1;
  for (const double parts : {0.5, 1.0, 2.0}) {
    const double error = std::abs(mean_over_box("E=470*rho^3.7", parts) - 100);
    EXPECT_LT(error, 0.2 * coarse);  // h^3 or better
    coarse = error;
  }
}

TEST(ElementModuli, BoundsAreCountedByVolume) {
  const Volume volume =
      sampled_volume({41, 3, 3}, {0.25, 5, 5}, [](const Vec3& p) { return 100 * (p.x - 2); });
  const TetMesh mesh = box_mesh({{0, 0, 0}, {10, 10, 10}}, {20, 1, 1});
  ElementModuliOptions options = milligrams("morgan-2003-femoral-neck");
  options.density_max = 0.7;
  options.modulus_min = 100;
  const ElementModuli found = element_moduli(mesh, volume, options);
  EXPECT_NEAR(found.share_below_min, 0.2, 0.01);     // x < 2
  EXPECT_NEAR(found.share_above_max, 0.1, 0.01);     // x > 9
  EXPECT_NEAR(found.share_outside_law, 0.46, 0.01);  // below 0.26 g/cm^3: x < 4.6
  EXPECT_EQ(*std::min_element(found.modulus.begin(), found.modulus.end()), 100);
  EXPECT_GT(found.share_of_modulus_min, 0.2);
  EXPECT_LT(found.share_of_modulus_min, 0.3);
  EXPECT_EQ(*std::min_element(found.density.begin(), found.density.end()), 0);
  EXPECT_NEAR(*std::max_element(found.density.begin(), found.density.end()), 0.7, 1e-12);
}

TEST(ElementModuli, HaveTheSameBitsForAnyNumberOfThreads) {
  std::mt19937 random(4);
  const Volume volume = sampled_volume({12, 12, 12}, {1, 1, 1}, [&](const Vec3&) {
    return std::uniform_real_distribution<double>(-100, 1500)(random);
  });
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {11, 11, 11}}, {7, 6, 9}, 0.3);
  ElementModuliOptions options = milligrams("keyak-1994");
  options.density_max = 1.2;
  const auto run = [&] { return element_moduli(mesh, volume, options); };
  const ElementModuli one = with_threads(1, run), three = with_threads(3, run);
  EXPECT_EQ(one.modulus, three.modulus);
  EXPECT_EQ(one.density, three.density);
  EXPECT_EQ(one.share_below_min, three.share_below_min);
  EXPECT_EQ(one.share_above_max, three.share_above_max);
  EXPECT_GT(one.share_above_max, 0);
}

TEST(ElementModuli, WhatCannotBeUsedIsRefused) {
  const Volume volume = sampled_volume({5, 5, 5}, {1, 1, 1}, [](const Vec3&) { return 500; });
  const TetMesh mesh = box_mesh({{0, 0, 0}, {4, 4, 4}}, {1, 1, 1});
  const ElementModuliOptions good = milligrams("E=1*rho^1");
  const auto refused = [&](auto change, const auto& matcher) {
    ElementModuliOptions options = good;
    change(options);
    EXPECT_REFUSED(element_moduli(mesh, volume, options), matcher);
  };
  refused([](auto& o) { o.law = {}; }, HasSubstr("no range"));
  refused([](auto& o) { o.calibration = {}; }, HasSubstr("positive slope, found 0"));
  refused([](auto& o) { o.density_min = -1; }, HasSubstr("found -1"));
  refused([](auto& o) { o.density_max = 0; }, HasSubstr("above the least, found 0"));
  refused([](auto& o) { o.modulus_min = 0; }, HasSubstr("above 0 MPa, found 0"));
  refused([](auto& o) { o.parts_per_voxel = 0; }, HasSubstr("parts per voxel, found 0"));
  refused([](auto& o) { o.parts_per_voxel = std::numeric_limits<double>::infinity(); },
          HasSubstr("found inf"));
  TetMesh far = mesh;
  far.points[3].z = 5.5;
  EXPECT_REFUSED(element_moduli(far, volume, good),
                 AllOf(HasSubstr("point 3"), HasSubstr("axis 2, found 5.5")));
  TetMesh torn = mesh;
  torn.cells[2][1] = 8;
  EXPECT_REFUSED(element_moduli(torn, volume, good),
                 HasSubstr("cell 2 names point 8, there are 8"));
  Volume flat = volume;
  flat.size = {125, 1, 1};
  EXPECT_REFUSED(element_moduli(mesh, flat, good), HasSubstr("125 x 1 x 1"));
  Volume short_of = volume;
  short_of.samples.pop_back();
  EXPECT_REFUSED(element_moduli(mesh, short_of, good), HasSubstr("124 samples"));
  Volume unknown = volume;
  unknown.samples[62] = std::nanf("");
  EXPECT_REFUSED(element_moduli(mesh, unknown, good), HasSubstr("is not finite"));
}

}  // namespace
}  // namespace mesamis
