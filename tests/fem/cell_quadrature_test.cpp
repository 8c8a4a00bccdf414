// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/cell_quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesamis/mesh/tet_mesh.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

double linear(const Vec3& p) { return 10 + 3 * p.x - 2 * p.y + 0.5 * p.z; }

TEST(CellQuadrature, LinearImagesAreExactForCellsOfAnyShape) {
  const Volume image = sampled_volume({21, 19, 17}, {1, 0.5, 2}, linear);
  const SplineImage spline = interpolating_spline(image);
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
    const auto fit = fit_image_on_cell(spline, p);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(fit[i], linear(p[i]), 2e-4);
  }
}

using Values = std::array<double, 4>;

/// Weighted least squares, sample by sample, solved by Gauss and Jordan.
class SlowFit {
 public:
  void add(const Values& l, double value, double weight = 1) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) rows_[i][j] += weight * l[i] * l[j];
      rows_[i][4] += weight * l[i] * value;
    }
    ++count_;
  }
  int count() const { return count_; }
  Values solve() {
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t r = 0; r < 4; ++r) {
        const double factor = r == c ? 0 : rows_[r][c] / rows_[c][c];
        for (std::size_t k = 0; k < 5; ++k) rows_[r][k] -= factor * rows_[c][k];
      }
    }
    Values x{};
    for (std::size_t i = 0; i < 4; ++i) x[i] = rows_[i][4] / rows_[i][i];
    return x;
  }

 private:
  std::array<std::array<double, 5>, 4> rows_{};
  int count_ = 0;
};

/// The lattice that a cell of this volume (in voxels) gets; 0: the fixed places.
int density_for(double volume) {
  for (int d = 1; d <= 2; ++d) {
    if (volume * d * d * d >= 40) return d;
  }
  return 0;
}

Values slow_fit(const SplineImage& spline, const std::array<Vec3, 4>& p, int density) {
  const double whole = six_volume(p[0], p[1], p[2], p[3]);
  const VoxelGrid& image = spline.grid;
  const auto value_at = [&spline](const Vec3& q) {
    return std::clamp<double>(spline_at(spline, q).value, spline.low, spline.high);
  };
  SlowFit fit;
  if (density == 0) {
    // Walkington's 14 points: three or two coordinates are alike.
    const auto add = [&](const Values& l, double weight) {
      fit.add(l, value_at(l[0] * p[0] + l[1] * p[1] + l[2] * p[2] + l[3] * p[3]), weight);
    };
    for (std::size_t i = 0; i < 4; ++i) {
      for (const auto& [alike, weight] :
           {std::pair{0.310885919263300610, 0.112687925718015851},
            std::pair{0.0927352503108912264, 0.0734930431163619495}}) {
        Values l{alike, alike, alike, alike};
        l[i] = 1 - 3 * alike;
        add(l, weight);
      }
      for (std::size_t j = i + 1; j < 4; ++j) {
        Values l{0.0455037041256496495, 0.0455037041256496495, 0.0455037041256496495,
                 0.0455037041256496495};
        l[i] = l[j] = 0.45449629587435035;
        add(l, 0.0425460207770814664);
      }
    }
    return fit.solve();
  }
  for (int k = 0; k < image.size[2] * density; ++k) {
    for (int j = 0; j < image.size[1] * density; ++j) {
      for (int i = 0; i < image.size[0] * density; ++i) {
        const Vec3 q{((i + 0.5) / density - 0.5) * image.spacing.x,
                     ((j + 0.5) / density - 0.5) * image.spacing.y,
                     ((k + 0.5) / density - 0.5) * image.spacing.z};
        const Values l{
            six_volume(q, p[1], p[2], p[3]) / whole, six_volume(p[0], q, p[2], p[3]) / whole,
            six_volume(p[0], p[1], q, p[3]) / whole, six_volume(p[0], p[1], p[2], q) / whole};
        if (*std::min_element(l.begin(), l.end()) >= 0) fit.add(l, value_at(q));
      }
    }
  }
  return fit.solve();
}

/// A clever summation agrees with brute force, on an image that is linear nowhere.
TEST(CellQuadrature, AgreesWithASumOverAllSamples) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  int on_voxels = 0;
  for (const auto& [size, spacing] : {std::pair{std::array<Index, 3>{12, 11, 10}, Vec3{1, 0.5, 2}},
                                      std::pair{std::array<Index, 3>{2, 14, 9}, Vec3{3, 1, 1}},
                                      std::pair{std::array<Index, 3>{13, 9, 2}, Vec3{1, 1, 4}}}) {
    const Volume image =
        sampled_volume(size, spacing, [&](const Vec3&) { return 100 * uniform(generator); });
    const SplineImage spline = interpolating_spline(image);
    const Vec3 extent = image.box().extent();
    std::array<int, 3> tried{};
    int next_taken = 0;
    for (int n = 0; n < 120; ++n) {
      // Nearly regular cells from a corner, so that the samples determine the fit.
      const double length = std::pow(10, 1 - 1.3 * uniform(generator));
      std::array<Vec3, 4> p{};
      for (int axis = 0; axis < 3; ++axis) {
        const double side = std::min(extent[axis], length * spacing[axis]);
        const double start = uniform(generator) * (extent[axis] - side);
        for (std::size_t i = 0; i < 4; ++i) {
          p[i][axis] = start + side * (axis + 1 == static_cast<int>(i) ? 0.97 : 0.02) +
                       0.01 * side * uniform(generator);
        }
      }
      const double voxels =
          six_volume(p[0], p[1], p[2], p[3]) / 6 / (spacing.x * spacing.y * spacing.z);
      const int density = density_for(voxels);
      ++tried[static_cast<std::size_t>(density)];
      const Values found = fit_image_on_cell(spline, p);
      auto agrees_at = [&](int d) {
        const Values expected = slow_fit(spline, p, d);
        return std::equal(found.begin(), found.end(), expected.begin(),
                          [](double a, double b) { return std::abs(a - b) < 1e-7; });
      };
      if (agrees_at(density)) continue;
      // Samples that happen to lie badly: then the next lattice, or the fixed places.
      ++next_taken;
      EXPECT_TRUE(density > 0 && agrees_at(density == 2 ? 0 : 2)) << voxels;
    }
    EXPECT_LE(next_taken, 3);
    EXPECT_GT(tried[0], 5);
    EXPECT_GT(tried[2], 5);
    on_voxels += tried[1];
  }
  EXPECT_GT(on_voxels, 5);
}

// Against the integrals of monomials of the barycentric coordinates, a! b! c! d! 3! / (a+b+c+d+3)!.
TEST(CellQuadrature, ASmallCellGetsTheProjectionOfACubicImage) {
  constexpr double kSide = 3;  // voxels: 4.5 of them in the cell
  const Vec3 corner{16, 16, 16};
  const Volume image = sampled_volume({33, 33, 33}, {1, 1, 1}, [&](const Vec3& p) {
    const Vec3 l = (1 / kSide) * (p - corner);
    return l.x * l.x * l.y;
  });
  const auto fit = fit_image_on_cell(
      interpolating_spline(image),
      {corner, corner + Vec3{kSide, 0, 0}, corner + Vec3{0, kSide, 0}, corner + Vec3{0, 0, kSide}});
  const Values loads{12.0 / 5040, 36.0 / 5040, 24.0 / 5040, 12.0 / 5040};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((fit[i] + fit[0] + fit[1] + fit[2] + fit[3]) / 20, loads[i], 5e-6);
  }
}

TEST(CellQuadrature, ALargeCellAveragesAllItsVoxels) {
  // White noise of deviation 10 over thousands of voxels: the fit's noise falls with the count.
  std::mt19937 generator(4);
  std::normal_distribution<double> noise(100, 10);
  const Volume image =
      sampled_volume({41, 41, 41}, {1, 1, 1}, [&](const Vec3&) { return noise(generator); });
  const SplineImage spline = interpolating_spline(image);
  const auto fit =
      fit_image_on_cell(spline, {Vec3{0, 0, 0}, Vec3{40, 0, 0}, Vec3{0, 40, 0}, Vec3{0, 0, 40}});
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
        const SplineImage spline = interpolating_spline(image);
        const auto fit = fit_image_on_cell(spline, cell);
        const double mean = (fit[0] + fit[1] + fit[2] + fit[3]) / 4;
        EXPECT_NEAR(mean * 288, 1, 0.75);
        image.samples[image.offset(i, j, k)] = 0;
      }
    }
  }
}

}  // namespace
}  // namespace mesamis
