// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/thin_sheets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/spline_image.h"
#include "mesamis/restore/deblur.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

constexpr double kOutside = 120, kInside = 230, kBlur = 0.8;
const Vec3 kNormal = (1 / norm(Vec3{1, 0.4, 0.2})) * Vec3{1, 0.4, 0.2};
const Vec3 kMiddle{15.3, 15.1, 14.8};

double step(double t) { return 0.5 * std::erfc(-t / (kBlur * std::sqrt(2))); }

/// A blurred slab, askew, brighter or darker than what is around it.
Volume slab(double thickness, double around, double within, double noise = 0) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 1);
  return sampled_volume({31, 31, 31}, {1, 1, 1}, [&](const Vec3& p) {
    const double d = dot(p - kMiddle, kNormal);
    const double share = step(d + thickness / 2) - step(d - thickness / 2);
    return around + (within - around) * share + noise * normal(generator);
  });
}

Volume lifted(Volume scan, double noise = 0) {
  const SheetOptions options{
      .contrast = {kOutside, kInside, 1000}, .blur = {kBlur, kBlur, kBlur}, .noise = noise};
  const Volume guide = smoothed(scan);
  lift_thin_sheets(scan, guide, options);
  return scan;
}

/// How thick the part on the inner side of the middle grey value is, along the normal.
double thickness_at_middle(const Volume& volume, double sign) {
  constexpr double kStep = 0.01;
  const SplineImage image = interpolating_spline(volume);
  double sum = 0;
  for (double d = -5; d < 5; d += kStep) {
    const double value = spline_at(image, kMiddle + d * kNormal).value;
    if (sign * (value - (kOutside + kInside) / 2) > 0) sum += kStep;
  }
  return sum;
}

TEST(LiftThinSheets, WallsAndGapsGetTheirThickness) {
  for (const double thickness : {0.6, 0.8, 1.0, 1.4, 2.0}) {
    const Volume wall = slab(thickness, kOutside, kInside),
                 gap = slab(thickness, kInside, kOutside);
    if (thickness < 1) {
      EXPECT_EQ(thickness_at_middle(wall, 1), 0) << "the blur hides it";
      EXPECT_EQ(thickness_at_middle(gap, -1), 0);
    }
    EXPECT_NEAR(thickness_at_middle(lifted(wall), 1), thickness, 0.25) << thickness;
    EXPECT_NEAR(thickness_at_middle(lifted(gap), -1), thickness, 0.25) << thickness;
  }
}

/// Against noise the filter leaves blur, and rings: the faces of walls of some two voxels come out
/// above half of the contrast.
TEST(LiftThinSheets, WallsThatTheFilterRaisesGetTheirThickness) {
  for (const double regularization : {0.003, 0.04}) {
    const SheetOptions options{.contrast = {kOutside, kInside, 1000},
                               .blur = {kBlur, kBlur, kBlur},
                               .regularization = regularization,
                               .undone = {0.72, 0.72, 0.72}};
    const auto restored = [&](const Volume& scan) {
      Volume volume = deblurred(scan, options.undone, regularization);
      lift_thin_sheets(volume, smoothed(scan), options);
      return volume;
    };
    for (const double thickness : {1.0, 1.4, 1.8, 2.2, 2.6}) {
      const Volume wall = slab(thickness, kOutside, kInside),
                   gap = slab(thickness, kInside, kOutside);
      EXPECT_NEAR(thickness_at_middle(restored(wall), 1), thickness, 0.1) << regularization;
      EXPECT_GT(thickness_at_middle(restored(gap), -1), thickness - 0.1) << "it stays open";
    }
  }
}

TEST(LiftThinSheets, WallsThatAreLessDenseThanTheObjectAreFound) {
  for (const double density : {0.4, 0.45}) {
    const Volume wall = slab(2.5, kOutside, kOutside + density * (kInside - kOutside));
    EXPECT_EQ(thickness_at_middle(wall, 1), 0) << "one level loses it";
    EXPECT_NEAR(thickness_at_middle(lifted(wall), 1), 2, 1) << density;
  }
  // A gap that is filled halfway with something is none.
  const Volume gap = slab(2.5, kInside, kInside + 0.4 * (kOutside - kInside));
  EXPECT_LT(thickness_at_middle(lifted(gap), -1), 1);
}

TEST(LiftThinSheets, KnowsWhatWasUndoneAlongTheNormal) {
  // Across x 0.7 voxels of blur were undone, across z none: each wall gets its thickness.
  for (const int axis : {0, 2}) {
    constexpr double kOfX = 0.8, kOfZ = 0.35, kThickness = 0.9;
    const double blur = axis == 0 ? kOfX : kOfZ;
    const Volume scan = sampled_volume({31, 31, 31}, {1, 1, 1}, [&](const Vec3& p) {
      const double d = p[axis] - 15.2, scale = 1 / (blur * std::sqrt(2));
      return kOutside +
             55 * (std::erf((d + kThickness / 2) * scale) - std::erf((d - kThickness / 2) * scale));
    });
    const SheetOptions options{.contrast = {kOutside, kInside, 1000},
                               .blur = {kOfX, kOfX, kOfZ},
                               .regularization = 0.01,
                               .undone = {0.7, 0.7, 0}};
    Volume lifted = deblurred(scan, options.undone, *options.regularization);
    lift_thin_sheets(lifted, smoothed(scan), options);
    const SplineImage image = interpolating_spline(lifted);
    double sum = 0;
    for (double d = -4; d < 4; d += 0.01) {
      Vec3 p{15.3, 15.1, 14.8};
      p[axis] = 15.2 + d;
      if (spline_at(image, p).value > (kOutside + kInside) / 2) sum += 0.01;
    }
    EXPECT_NEAR(sum, kThickness, 0.25) << axis;
  }
}

TEST(LiftThinSheets, LeavesThickSlabsAndTheirSurroundings) {
  const Volume scan = slab(7, kOutside, kInside);
  const Volume after = lifted(scan);
  for (std::size_t n = 0; n < scan.samples.size(); ++n) {
    EXPECT_NEAR(after.samples[n], scan.samples[n], 1e-3);
  }
}

TEST(LiftThinSheets, LeavesBallsAndRods) {
  // Of a sheet the gradients agree in one direction; not so of a small ball or a thin rod.
  const Volume ball = make_ball({.size = 24, .noise = 0, .radius = 1.2, .blur = 0.8});
  const Volume rod = sampled_volume({24, 24, 24}, {1, 1, 1}, [](const Vec3& p) {
    return kOutside + 60 * std::exp(-((p.x - 12) * (p.x - 12) + (p.y - 12) * (p.y - 12)) / 2);
  });
  for (const Volume& scan : {ball, rod}) {
    const Volume after = lifted(scan);
    double most = 0;
    for (std::size_t n = 0; n < scan.samples.size(); ++n) {
      most = std::max<double>(most, std::abs(after.samples[n] - scan.samples[n]));
    }
    EXPECT_LT(most, 0.15 * (kInside - kOutside));
  }
}

TEST(LiftThinSheets, MakesNothingOfNoise) {
  for (const double noise : {10.0, 30.0}) {
    const Volume scan = slab(0, kOutside, kOutside, noise);
    const Volume after = lifted(scan, noise);
    EXPECT_EQ(after.samples, scan.samples) << noise;
  }
}

TEST(LiftThinSheets, SameBitsForAnyNumberOfThreads) {
  const Volume scan = slab(0.9, kOutside, kInside, 4);
  const Volume one = with_threads(1, [&] { return lifted(scan, 4); });
  const Volume three = with_threads(3, [&] { return lifted(scan, 4); });
  EXPECT_EQ(one.samples, three.samples);
}

}  // namespace
}  // namespace mesamis
