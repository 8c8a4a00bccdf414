// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/mes_amis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/method/choose.h"
#include "mesamis/method/expected_error.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"
#include "support/solids.h"

namespace mesamis {
namespace {

Settings small_run() {
  Settings settings;
  settings.max_tets = 4000;
  settings.adaptations = 3;
  return settings;
}

BallVolume ball() { return {.size = 26, .noise = 10, .radius = 7}; }

/// The small run of the ball, by one thread, for all tests that look at it or compare with it.
const Result& small_result() {
  static const Result result =
      with_threads(1, [] { return mes_amis(make_ball(ball()), small_run()); });
  return result;
}

double mean_radius_error(const Result& result, const Vec3& center, double radius) {
  double sum = 0;
  for (const Vec3& p : result.surface.points) sum += std::abs(norm(p - center) - radius);
  return sum / static_cast<double>(result.surface.points.size());
}

TEST(MesAmis, FindsABallAndClosesItsSurface) {
  const Volume volume = make_ball(ball());
  const Result& result = small_result();
  const SurfaceCheck check = check_surface(result.surface);
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_NEAR(result.parameters.level, 175, 6);
  EXPECT_FALSE(result.parameters.grey.has_threshold());
  const double middle = 4.0 / 3 * std::numbers::pi * std::pow(middle_radius(7, 1), 3);
  EXPECT_NEAR(check.volume / middle, 1, 0.04);
  EXPECT_LT(mean_radius_error(result, 0.5 * volume.box().extent(), 7), 0.25);
}

TEST(MesAmis, PreviewsTheSolidWithoutAMesh) {
  const Volume volume = make_ball(ball());
  Settings settings;
  settings.preview = true;
  const Result result = mes_amis(volume, settings);
  EXPECT_TRUE(result.parameters.preview);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations.size(), 1U);
  EXPECT_TRUE(result.mesh.cells.empty());
  EXPECT_EQ(flaws_of(check_surface(result.surface)), "");
  EXPECT_LT(mean_radius_error(result, 0.5 * volume.box().extent(), 7), 0.25);
  EXPECT_EQ(*result.parameters.tolerance, 0) << "it is shown, not printed";
  EXPECT_EQ(std::ssize(result.surface.triangles), result.printable.triangles_extracted);
  EXPECT_TRUE(result.printable.within(*result.parameters.tolerance));
  EXPECT_EQ(result.expected_error.size(), result.surface.points.size());
  const Result again =
      with_threads(1, [&] { return mes_amis(volume, settings_of(result.parameters)); });
  EXPECT_EQ(again.surface.points, result.surface.points);
}

/// A dense ball beside one of which a level midway between the dense one and the background finds a
/// grain alone.
Volume unlike_balls() {
  Volume scan = sampled_volume({52, 26, 26}, {1, 1, 1}, [](const Vec3& p) {
    const double light = norm(p - Vec3{38, 13, 13});
    return 50 + 1150 * blurred_ball(norm(p - Vec3{13, 13, 13}), 8, 0.7) +
           300 * blurred_ball(light, 8, 0.7) + 600 * blurred_ball(light, 1.5, 0.7);
  });
  scan.modality = "CT";
  return scan;
}

TEST(MesAmis, ALevelForEachPlaceFindsWhatIsLessDense) {
  Settings settings;
  settings.max_tets = 8000;
  settings.adaptations = 2;
  const Volume scan = unlike_balls();
  const double ball = 4.0 / 3 * std::numbers::pi * std::pow(8, 3);
  const Result result = mes_amis(scan, settings);
  const SurfaceCheck check = check_surface(result.surface);
  EXPECT_EQ(solid_flaws_of(check), "");
  EXPECT_EQ(check.components, 2);
  EXPECT_NEAR(check.volume / (2 * ball), 1, 0.04);
  EXPECT_LT(result.image.level_range[0], 250);
  EXPECT_GT(result.image.level_range[1], 550);
  // The fields are those of the scan, and the object's cells are those of both balls.
  const GreyMap& grey = result.parameters.grey;
  for (std::size_t n = 0; n < result.u.size(); ++n) {
    const Vec3& p = result.mesh.points[n];
    const double light = norm(p - Vec3{38, 13, 13});
    if (light > 3.5 && light < 5.5) {
      EXPECT_NEAR(grey.to_native(result.u[n]), 350, 40);
    }
    if (norm(p - Vec3{13, 13, 13}) < 4) {
      EXPECT_NEAR(grey.to_native(result.u[n]), 1200, 60);
    }
  }
  EXPECT_EQ(result.level_excess.size(), result.u.size());
  EXPECT_EQ(mes_amis(scan, settings_of(result.parameters)).surface.points, result.surface.points);
  settings.local_level = false;
  EXPECT_LT(check_surface(mes_amis(scan, settings).surface).volume, 1.2 * ball);
}

/// Elsewhere values do not tell density from structure: the struts of a spongy bone are of one kind.
TEST(MesAmis, ALevelForEachPlaceIsForHounsfieldUnits) {
  Settings settings;
  settings.max_tets = 4000;
  settings.adaptations = 1;
  Volume scan = unlike_balls();
  scan.modality = "MR";
  const Result result = mes_amis(scan, settings);
  EXPECT_FALSE(result.parameters.local_level);
  EXPECT_FALSE(result.image.has_local_levels());
  settings.local_level = false;
  EXPECT_EQ(mes_amis(scan, settings).surface.points, result.surface.points);
}

TEST(MesAmis, ALevelForEachPlaceIsThatOfTheOneMaterial) {
  Settings settings = small_run();
  Volume scan = make_ball(ball());
  scan.modality = "CT";
  const Result result = with_threads(1, [&] { return mes_amis(scan, settings); });
  EXPECT_TRUE(result.parameters.local_level);
  EXPECT_FALSE(result.image.has_local_levels());
  settings.local_level = false;
  EXPECT_EQ(with_threads(1, [&] { return mes_amis(scan, settings); }).surface.points,
            result.surface.points);
}

TEST(MesAmis, ANumberIsTheLevelOfAllPlaces) {
  Settings settings;
  settings.max_tets = 8000;
  settings.adaptations = 2;
  settings.level = 625;
  const Result result = mes_amis(unlike_balls(), settings);
  EXPECT_LT(check_surface(result.surface).volume, 1.2 * 4.0 / 3 * std::numbers::pi * std::pow(8, 3))
      << "of the light ball there is the grain alone";
  EXPECT_FALSE(result.parameters.local_level);
}

TEST(MesAmis, DeliversAValidMeshWithinTheCount) {
  const Volume volume = make_ball(ball());
  const Result& result = small_result();
  EXPECT_NO_THROW(validate(result.mesh, volume.box()));
  EXPECT_NEAR(static_cast<double>(result.mesh.cells.size()) / 4000, 1, 0.1);
  for (const auto* field : {&result.u, &result.v, &result.f}) {
    EXPECT_EQ(field->size(), result.mesh.points.size());
  }
  EXPECT_THAT(result.v, ::testing::Each(::testing::AllOf(::testing::Ge(0), ::testing::Le(1))));
  EXPECT_EQ(result.metric.size(), result.mesh.points.size());
  EXPECT_GT(result.fit.unit_edge_fraction, 0.8);
}

TEST(MesAmis, RecordsHowFarEachMeshMovesTheSurface) {
  const Result& result = small_result();
  ASSERT_EQ(result.iterations.size(), 4u) << "three adaptations and the final minimisation";
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations[0].surface_change, 0) << "nothing to compare with";
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_GT(result.iterations[k].surface_change, 0) << k;
    EXPECT_LT(result.iterations[k].surface_change, 0.5) << k;
    EXPECT_NEAR(result.iterations[k].surface_tolerance, 0.2, 1e-12) << "a fifth of a voxel";
  }
  EXPECT_LT(result.iterations[3].surface_change, result.iterations[1].surface_change);
}

TEST(MesAmis, DecimatesNoCloserThanTheSurfaceIsKnown) {
  BallVolume quiet = ball();
  quiet.noise = 3;
  const Volume volume = make_ball(quiet);
  Settings settings = small_run();
  settings.level = 175;  // one that is given is sure: the error is that of the shape
  const Result result = mes_amis(volume, settings);
  const double tolerance = *result.parameters.tolerance;
  EXPECT_GT(tolerance, 0.06);
  EXPECT_LT(tolerance, 0.28);
  const double expected = summarize_error(result.surface, result.expected_error).mean;
  // As expected_error() counts it.
  const double decimation =
      std::max(result.printable.extracted_to_result, result.printable.result_to_extracted) / 4;
  const double before = std::sqrt(expected * expected - decimation * decimation);
  EXPECT_NEAR(before, tolerance / kErrorsOfObject, 0.007) << "told of the surface before";
  settings.tolerance = 0.05;
  EXPECT_EQ(mes_amis(volume, settings).parameters.tolerance, 0.05);
}

TEST(MesAmis, TheLevelDependsOnNeitherStrideNorCells) {
  const Volume volume = make_ball(ball());
  Settings settings = small_run();
  settings.adaptations = 1;
  settings.stride = std::array<Index, 3>{2, 2, 2};
  settings.max_tets = 8000;
  EXPECT_EQ(mes_amis(volume, settings).parameters.level, small_result().parameters.level);
}

TEST(MesAmis, TellsTheGreyValueBeneathTheSurface) {
  const Result& result = small_result();
  const std::vector<double> greys = surface_grey(result, 1);
  ASSERT_EQ(greys.size(), result.surface.points.size());
  const double level = result.parameters.grey.to_grey(result.parameters.level);
  const double inside = *std::max_element(result.u.begin(), result.u.end());
  for (const double grey : greys) {
    EXPECT_GE(grey, level - 1e-3) << "the way begins on the level";
    EXPECT_LE(grey, inside);
    EXPECT_GT(grey, level + 0.3 * (inside - level)) << "the ball is far thicker than the way";
  }
}

TEST(MesAmis, StoppedItDeliversTheLastMeshAndSaysSo) {
  const Volume volume = make_ball(ball());
  const auto run = [&volume](int threads) {
    int asked = 0;
    return with_threads(
        threads, [&] { return mes_amis(volume, small_run(), {}, [&] { return ++asked == 2; }); });
  };
  const Result result = run(1);
  EXPECT_TRUE(result.stopped);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations.size(), 2u) << "one adaptation and the final minimisation";
  EXPECT_NO_THROW(validate(result.mesh, volume.box()));
  EXPECT_TRUE(check_surface(result.surface).closed());
  EXPECT_EQ(result.expected_error.size(), result.surface.points.size());
  EXPECT_EQ(run(2).surface.points, result.surface.points);
}

TEST(MesAmis, StoppedBeforeItsFirstPassItDeliversThePreview) {
  const Volume volume = make_ball(ball());
  Settings settings = small_run();
  const Result stopped = mes_amis(volume, settings, {}, [] { return true; });
  settings.preview = true;
  const Result preview = mes_amis(volume, settings, {}, [] { return true; });
  EXPECT_TRUE(stopped.stopped);
  EXPECT_FALSE(stopped.converged);
  EXPECT_TRUE(stopped.mesh.cells.empty());
  EXPECT_TRUE(stopped.parameters.preview);
  EXPECT_FALSE(preview.stopped) << "it is what was asked for";
  EXPECT_EQ(stopped.surface.points, preview.surface.points);
  settings = small_run();
  settings.surface = SurfaceKind::kBand;
  const Result band = mes_amis(volume, settings, {}, [] { return true; });
  EXPECT_TRUE(band.stopped);
  EXPECT_EQ(band.iterations.size(), 2u) << "a band has no preview";
}

TEST(MesAmis, OneThatNeverHasEnoughChangesNothing) {
  const Result b = mes_amis(make_ball(ball()), small_run(), {}, [] { return false; });
  EXPECT_FALSE(b.stopped);
  EXPECT_EQ(small_result().surface.points, b.surface.points);
}

TEST(MesAmis, TheSameBitsForAnyNumberOfThreads) {
  const Result& a = small_result();
  const Result b = with_threads(3, [] { return mes_amis(make_ball(ball()), small_run()); });
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.cells, b.mesh.cells);
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.surface.points, b.surface.points);
  EXPECT_EQ(a.surface.triangles, b.surface.triangles);
  EXPECT_EQ(surface_grey(a, 1), surface_grey(b, 1));
}

TEST(MesAmis, AnObliqueScanGivesTheSameSurfaceTurned) {
  Volume volume = make_ball(ball());
  Settings settings = small_run();
  settings.tolerance = 0;  // rounding to single precision is not turned
  const Result straight = mes_amis(volume, settings);
  volume.origin = {10, -20, 30};
  volume.direction.rows = {Vec3{0, -1, 0}, Vec3{0.6, 0, -0.8}, Vec3{0.8, 0, 0.6}};
  const Result turned = mes_amis(volume, settings);
  ASSERT_EQ(straight.surface.points.size(), turned.surface.points.size());
  for (std::size_t n = 0; n < turned.surface.points.size(); ++n) {
    EXPECT_NEAR(norm(turned.surface.points[n] - volume.to_world(straight.surface.points[n])), 0,
                1e-9);
  }
  EXPECT_NEAR(check_surface(turned.surface).volume / check_surface(straight.surface).volume, 1,
              1e-9);
}

TEST(MesAmis, AMirroredScanKeepsItsOrientationOutward) {
  Volume volume = make_ball(ball());
  volume.direction.rows[0] = {-1, 0, 0};
  const Result result = mes_amis(volume, small_run());
  EXPECT_GT(check_surface(result.surface).volume, 0);
  for (std::size_t c = 0; c < result.mesh.cells.size(); ++c) {
    EXPECT_GT(cell_volume(result.mesh, static_cast<Index>(c)), 0);
  }
}

TEST(MesAmis, ScalesWithTheVoxelSize) {
  // Lengths are measured in voxels: a scan with voxels of 0.02 mm gives the same mesh, smaller.
  BallVolume fine = ball();
  fine.spacing = {0.02, 0.02, 0.02};
  fine.radius *= 0.02;
  fine.blur *= 0.02;
  const Result& a = small_result();
  const Result b = mes_amis(make_ball(fine), small_run());
  EXPECT_NEAR(check_surface(b.surface).volume / check_surface(a.surface).volume, 8e-6, 8e-8);
}

TEST(MesAmis, ClampsSoftTissueInAThreeClassImage) {
  const Volume volume = make_ball(
      {.size = 32, .background = 40, .object = 900, .noise = 15, .radius = 7, .air = -1000});
  const Result result = mes_amis(volume, small_run());
  EXPECT_TRUE(result.parameters.grey.has_threshold());
  EXPECT_NEAR(result.parameters.level, 470, 50);
  EXPECT_EQ(check_surface(result.surface).components, 1);
  EXPECT_LT(mean_radius_error(result, 0.5 * volume.box().extent(), 7), 0.3);
}

TEST(MesAmis, NoiseOfOneTissueIsNoSecondOne) {
  Settings settings = small_run();
  settings.adaptations = 1;
  const Result result = mes_amis(make_ball({.size = 40, .noise = 30, .radius = 7}), settings);
  EXPECT_FALSE(result.parameters.grey.has_threshold());
}

TEST(MesAmis, BandLiesOnBothSidesOfTheEdge) {
  Settings settings = small_run();
  settings.surface = SurfaceKind::kBand;
  const Result result = mes_amis(make_ball({.size = 26, .noise = 2, .radius = 7}), settings);
  EXPECT_TRUE(check_surface(result.surface).closed());
  const Vec3 center{12.5, 12.5, 12.5};
  int inside = 0, outside = 0;
  for (const Vec3& p : result.surface.points) (norm(p - center) < 7 ? inside : outside)++;
  EXPECT_GT(inside, 10);
  EXPECT_GT(outside, 10);
}

TEST(MesAmis, StrideThinsTheFirstGridOnly) {
  Settings settings = small_run();
  settings.stride = std::array<Index, 3>{2, 2, 1};
  const Volume volume = make_ball(ball());
  const Result result = mes_amis(volume, settings);
  EXPECT_EQ(result.iterations[0].nodes, 13 * 13 * 26);
  EXPECT_NO_THROW(validate(result.mesh, volume.box()));
  EXPECT_LT(mean_radius_error(result, 0.5 * volume.box().extent(), 7), 0.3);
}

TEST(MesAmis, ProgressCanStopTheRun) {
  int calls = 0;
  const Progress stop = [&calls](std::string_view, double share) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    return ++calls < 3;
  };
  EXPECT_THROW(mes_amis(make_ball(ball()), small_run(), stop), Cancelled);
  EXPECT_EQ(calls, 3);
}

TEST(MesAmis, RefusesWhatItCannotUse) {
  Volume constant = make_ball(ball());
  constant.samples.assign(constant.samples.size(), 5);
  EXPECT_THROW(mes_amis(constant, Settings{}), InputError);
  Volume broken = make_ball(ball());
  broken.samples[100] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(mes_amis(broken, Settings{}), InputError);
  Settings settings;
  settings.gamma = 0;
  EXPECT_THROW(mes_amis(make_ball(ball()), settings), InputError);
  settings = {};
  settings.crop.begin = {25, 0, 0};
  EXPECT_THROW(mes_amis(make_ball(ball()), settings), InputError);
}

}  // namespace
}  // namespace mesamis
