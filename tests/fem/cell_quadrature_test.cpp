// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/cell_quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/mesh/tet_mesh.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

double linear(const Vec3& p) { return 10 + 3 * p.x - 2 * p.y + 0.5 * p.z; }

TEST(CellQuadrature, LinearImagesAreExactForCellsOfAnyShape) {
  const Volume image = sampled_volume({21, 19, 17}, {1, 0.5, 2}, linear);
  const Vec3 extent = image.box().extent();
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  int tried = 0;
  while (tried < 300) {
    // Sizes over four decades, flattened up to a thousandfold along a random axis.
    const Vec3 center{uniform(generator) * extent.x, uniform(generator) * extent.y,
                      uniform(generator) * extent.z};
    const double size = std::pow(10, 1 - 3 * uniform(generator));
    std::array<Vec3, 4> p;
    for (Vec3& q : p) {
      for (int axis = 0; axis < 3; ++axis) {
        const double flat = axis == tried % 3 ? std::pow(10, -3 * uniform(generator)) : 1;
        q[axis] =
            std::clamp(center[axis] + flat * size * (uniform(generator) - 0.5), 0.0, extent[axis]);
      }
    }
    const double volume = six_volume(p[0], p[1], p[2], p[3]);
    if (volume < 0) std::swap(p[2], p[3]);
    if (std::abs(volume) < 1e-9 * size * size * size) continue;
    ++tried;
    const auto fit = fit_image_on_cell(image, p);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(fit[i], linear(p[i]), 2e-4);
  }
}

TEST(CellQuadrature, ALargeCellAveragesAllItsVoxels) {
  // White noise of deviation 10 over thousands of voxels: the fit's noise falls with the count.
  std::mt19937 generator(4);
  std::normal_distribution<double> noise(100, 10);
  const Volume image =
      sampled_volume({41, 41, 41}, {1, 1, 1}, [&](const Vec3&) { return noise(generator); });
  const auto fit =
      fit_image_on_cell(image, {Vec3{0, 0, 0}, Vec3{40, 0, 0}, Vec3{0, 40, 0}, Vec3{0, 0, 40}});
  for (const double value : fit) EXPECT_NEAR(value, 100, 1.5);
}

TEST(CellQuadrature, EveryVoxelIsSeen) {
  // One bright voxel anywhere inside a large cell moves the cell's mean by 1/voxels.
  const std::array<Vec3, 4> cell{Vec3{0, 0, 0}, Vec3{12, 0, 0}, Vec3{0, 12, 0}, Vec3{0, 0, 12}};
  Volume image = sampled_volume({13, 13, 13}, {1, 1, 1}, [](const Vec3&) { return 0.0; });
  for (Index k = 1; k < 9; ++k) {
    for (Index j = 1; j + k < 10; ++j) {
      for (Index i = 1; i + j + k < 11; ++i) {
        image.samples[image.offset(i, j, k)] = 1;
        const auto fit = fit_image_on_cell(image, cell);
        const double mean = (fit[0] + fit[1] + fit[2] + fit[3]) / 4;
        EXPECT_NEAR(mean * 288, 1, 0.75);
        image.samples[image.offset(i, j, k)] = 0;
      }
    }
  }
}

}  // namespace
}  // namespace mesamis
