// SPDX-License-Identifier: Apache-2.0
#include "mesamis/baseline/geodesic_contour.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "mesamis/base/parallel.h"
#include "mesamis/baseline/isosurface.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kLevel = 175;  // between the phantom's 120 outside and 230 inside

class GeodesicContourTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_geodesic_contour()) GTEST_SKIP() << "the library was built without ITK";
  }
};

/// The ball in a box of 40 mm, blurred and noisy.
Phantom ball(const Vec3& spacing = {1, 1, 1}) {
  auto voxels = [](double mm) { return static_cast<Index>(std::lround(40 / mm)); };
  return make_phantom("sphere", {voxels(spacing.x), voxels(spacing.y), voxels(spacing.z)}, spacing);
}
Volume scan_of(const Phantom& phantom, double noise = 12) {
  return degrade(sample_phantom(phantom), {.blur = 0.8, .noise = noise});
}

/// Mean distance in mm of the surface's points, taken back to the phantom's frame, from the ball.
struct Deviation {
  double absolute = 0, outward = 0;
};
Deviation deviation(const TriMesh& surface, const Volume& at, const Phantom& phantom) {
  const Mat3 back = transpose(at.direction);
  Deviation mean;
  for (const Vec3& p : surface.points) {
    const double outward = -phantom.inside(back * (p - at.origin) + 0.5 * phantom.spacing);
    mean.absolute += std::abs(outward);
    mean.outward += outward;
  }
  const auto count = static_cast<double>(surface.points.size());
  return {mean.absolute / count, mean.outward / count};
}

void expect_ball(const GeodesicContour& contour, const Phantom& phantom, double bound) {
  EXPECT_TRUE(contour.report.converged);
  const TriMesh surface = isosurface(contour.level_set, 0);
  const SurfaceCheck check = check_surface(surface);
  EXPECT_EQ(solid_flaws_of(check), "");
  EXPECT_EQ(check.components, 1);
  const Deviation mean = deviation(surface, contour.level_set, phantom);
  EXPECT_LT(mean.absolute, bound);
  EXPECT_NEAR(mean.outward, 0, bound / 2);
}

TEST_F(GeodesicContourTest, FindsABallInNoise) {
  const Phantom phantom = ball();
  const GeodesicContour contour = geodesic_contour(scan_of(phantom), kLevel);
  expect_ball(contour, phantom, 0.3);
  const GeodesicReport& report = contour.report;
  EXPECT_GT(report.edge_gradient, report.flat_gradient);
  EXPECT_LT(report.alpha, 0);
  EXPECT_GT(report.beta, report.flat_gradient);
  EXPECT_LT(report.beta, report.edge_gradient);
  EXPECT_LT(report.rms_change, GeodesicOptions{}.rms_change);
}

TEST_F(GeodesicContourTest, DenoisesByDiffusion) {
  const Phantom phantom = ball();
  const GeodesicOptions options{.smooth_voxels = 0, .diffusions = 5};
  expect_ball(geodesic_contour(scan_of(phantom), kLevel, options), phantom, 0.3);
}

TEST_F(GeodesicContourTest, ComesToTheEdgeFromBothSides) {
  const Phantom phantom = ball();
  for (const double shrink : {-1.0, 1.0, 2.0}) {
    SCOPED_TRACE(shrink);
    expect_ball(geodesic_contour(scan_of(phantom), kLevel, {.shrink = shrink}), phantom, 0.3);
  }
}

TEST_F(GeodesicContourTest, HeedsSpacingAndDirection) {
  const Phantom phantom = ball({0.8, 1, 2});
  Volume volume = scan_of(phantom);
  volume.origin = {5, -7, 100};
  const double c = std::cos(0.4), s = std::sin(0.4);
  volume.direction.rows = {Vec3{-c, s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}};  // left-handed
  const GeodesicContour contour = geodesic_contour(volume, kLevel);
  EXPECT_EQ(contour.level_set.origin, volume.origin);
  EXPECT_EQ(contour.level_set.direction, volume.direction);
  expect_ball(contour, phantom, 0.35);
}

TEST_F(GeodesicContourTest, FindsADarkHoleInABrightObject) {
  const Phantom phantom = ball();
  Volume volume = scan_of(phantom);
  for (float& value : volume.samples) value = 350 - value;
  const GeodesicContour contour = geodesic_contour(volume, kLevel);
  const TriMesh surface = isosurface(contour.level_set, 0);
  const SurfaceCheck check = check_surface(surface);
  EXPECT_TRUE(check.closed());
  EXPECT_LT(check.volume, 0);
  EXPECT_LT(deviation(surface, volume, phantom).absolute, 0.3);
}

// Lengths count in voxels, and grey values against each other. With powers of two even the bits
// are the same.
TEST_F(GeodesicContourTest, DoesNotDependOnUnits) {
  const Volume volume = scan_of(ball());
  Volume other = volume;
  other.spacing = (1.0 / 32) * volume.spacing;
  for (float& value : other.samples) value *= 4;
  const GeodesicContour a = geodesic_contour(volume, kLevel);
  const GeodesicContour b = geodesic_contour(other, 4 * kLevel);
  EXPECT_EQ(a.level_set.samples, b.level_set.samples);
  EXPECT_EQ(128 * a.report.alpha, b.report.alpha);
  EXPECT_EQ(128 * a.report.beta, b.report.beta);
}

TEST_F(GeodesicContourTest, GivesTheSameBitsForAnyNumberOfThreads) {
  const Volume volume = scan_of(ball());
  const GeodesicOptions options{.diffusions = 2};
  const GeodesicContour one =
      with_threads(1, [&] { return geodesic_contour(volume, kLevel, options); });
  for (const int threads : {2, 5}) {
    const GeodesicContour many =
        with_threads(threads, [&] { return geodesic_contour(volume, kLevel, options); });
    EXPECT_EQ(one.level_set.samples, many.level_set.samples);
    EXPECT_EQ(one.report.rms_change, many.report.rms_change);
    EXPECT_EQ(one.report.alpha, many.report.alpha);
  }
}

TEST_F(GeodesicContourTest, EndsAtTheBoxWhereTheObjectLeavesIt) {
  const Phantom phantom = ball();
  const Volume half = crop(scan_of(phantom), {.begin = {20, 0, 0}, .end = {-1, -1, -1}});
  const GeodesicContour contour = geodesic_contour(half, kLevel);
  EXPECT_TRUE(contour.report.converged);
  EXPECT_FALSE(check_surface(isosurface(contour.level_set, 0)).closed());
  const SurfaceCheck check =
      check_surface(isosurface(contour.level_set, 0, {.close_at_box = true}));
  EXPECT_EQ(solid_flaws_of(check), "");
  // The box begins half a voxel beyond the middle.
  const double radius = phantom.inside({20, 20, 20});
  const double volume = std::numbers::pi * radius * radius * (2.0 / 3 * radius - 0.5);
  EXPECT_NEAR(check.volume / volume, 1, 0.05);
}

TEST_F(GeodesicContourTest, SaysWhenTheIterationsAreExhausted) {
  const Volume volume = scan_of(ball());
  for (const int iterations : {1, 20, 30}) {
    const GeodesicContour contour = geodesic_contour(
        volume, kLevel, {.shrink = 3, .iterations = iterations, .rms_change = 1e-6});
    EXPECT_FALSE(contour.report.converged);
    EXPECT_EQ(contour.report.iterations, iterations);
    EXPECT_GT(contour.report.rms_change, 1e-6);
    EXPECT_FALSE(isosurface(contour.level_set, 0).triangles.empty());
  }
}

TEST_F(GeodesicContourTest, StaysWhereItIsWithoutWeights) {
  const Phantom phantom = ball();
  const GeodesicContour contour = geodesic_contour(
      scan_of(phantom, 0), kLevel, {.propagation = 0, .curvature = 0, .advection = 0});
  EXPECT_LE(contour.report.iterations, 40);
  expect_ball(contour, phantom, 0.2);
}

TEST_F(GeodesicContourTest, CanBeCancelled) {
  const Volume volume = scan_of(ball());
  for (const std::string_view at : {"denoise", "evolve"}) {
    const Progress progress = [at](std::string_view stage, double share) {
      return stage != at || share < 0.3;
    };
    EXPECT_THROW(
        geodesic_contour(volume, kLevel, {.diffusions = 10, .iterations = 100, .rms_change = 1e-9},
                         progress),
        Cancelled);
  }
}

TEST_F(GeodesicContourTest, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  geodesic_contour(scan_of(ball()), kLevel, {.diffusions = 2, .iterations = 20});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(GeodesicContourTest, RefusesWhatHasNoContour) {
  const Volume volume = scan_of(ball());
  EXPECT_REFUSED(geodesic_contour(volume, 1e6), HasSubstr("both sides of the level"));
  EXPECT_REFUSED(geodesic_contour(volume, 232, {.smooth_voxels = 2}), HasSubstr("the level"));
  const Volume flat = crop(volume, {.begin = {0, 0, 18}, .end = {-1, -1, 21}});
  EXPECT_REFUSED(geodesic_contour(flat, kLevel), HasSubstr("4 voxels or more"));
  const Phantom small = make_phantom("sphere", {12, 12, 12});
  EXPECT_REFUSED(geodesic_contour(sample_phantom(small), kLevel, {.shrink = 4}),
                 HasSubstr("the contour's start"));
  EXPECT_REFUSED(geodesic_contour(sample_phantom(small), kLevel,
                                  {.beta = 1e6, .propagation = 0, .curvature = 10}),
                 HasSubstr("the contour's end"));
  // Noise alone: its gradients are the same everywhere.
  Volume noise = volume;
  std::fill(noise.samples.begin(), noise.samples.end(), 0.0f);
  noise = degrade(noise, {.noise = 10});
  EXPECT_REFUSED(geodesic_contour(noise, 12), HasSubstr("expected steeper edges"));
}

TEST(GeodesicOptionsTest, AreCheckedOneByOne) {
  const double nan = std::nan("");
  require_valid(GeodesicOptions{});
  EXPECT_REFUSED(require_valid(GeodesicOptions{.smooth_voxels = -1}),
                 HasSubstr("smooth: expected 0 to 100"));
  EXPECT_REFUSED(require_valid({.diffusions = -1}), HasSubstr("diffusions"));
  EXPECT_REFUSED(require_valid({.conductance = 0}), HasSubstr("conductance"));
  EXPECT_REFUSED(require_valid({.sigma = 0}), HasSubstr("sigma"));
  EXPECT_REFUSED(require_valid({.alpha = 1}), HasSubstr("alpha: expected less than 0, found 1"));
  EXPECT_REFUSED(require_valid({.beta = 0}), HasSubstr("beta"));
  EXPECT_REFUSED(require_valid({.shrink = nan}), HasSubstr("shrink"));
  EXPECT_REFUSED(require_valid({.propagation = -1}), HasSubstr("propagation"));
  EXPECT_REFUSED(require_valid({.curvature = nan}), HasSubstr("curvature"));
  EXPECT_REFUSED(require_valid({.advection = 1e9}), HasSubstr("advection"));
  EXPECT_REFUSED(require_valid({.iterations = 0}), HasSubstr("iterations"));
  EXPECT_REFUSED(require_valid({.rms_change = 0}), HasSubstr("rms change"));
}

TEST(GeodesicContourWithoutItk, IsRefused) {
  if (has_geodesic_contour()) GTEST_SKIP() << "the library was built with ITK";
  EXPECT_REFUSED(geodesic_contour(scan_of(ball()), kLevel), HasSubstr("without ITK"));
}

}  // namespace
}  // namespace mesamis
