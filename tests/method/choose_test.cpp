// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/choose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesamis/image/gaussian.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

Volume ball() { return make_ball({.size = 40, .noise = 8, .radius = 9}); }

TEST(Choose, TellsHowSurelyItKnowsTheLevel) {
  const Volume scan = ball();
  const Chosen open = choose(scan, {}).chosen;  // no settings, no level
  EXPECT_EQ(open.measured.level_uncertainty, open.object.uncertainty);
  Settings settings;
  settings.level = 160;
  const Chosen given = choose(scan, settings).chosen;
  EXPECT_EQ(given.parameters.level, 160);
  EXPECT_EQ(given.measured.level_uncertainty, 0) << "the user's";
  const Chosen found = choose(scan, {settings, KnownLevel{170, LevelSource::kScan, 7}}).chosen;
  EXPECT_EQ(found.parameters.level, 170) << "before the user's";
  EXPECT_EQ(found.measured.level_uncertainty, 7);
}

TEST(Choose, LeavesTheToleranceOpenUnlessItIsGiven) {
  Settings settings;
  settings.triangles = 500;
  EXPECT_FALSE(choose(ball(), settings).chosen.parameters.tolerance);
  settings.tolerance = 0.2;
  EXPECT_EQ(choose(ball(), settings).chosen.parameters.tolerance, 0.2);
}

/// Two balls of other density, and a wall whose blur keeps a window in it from its own value.
Volume bones_with_a_window() {
  Volume scan = sampled_volume({56, 28, 56}, {1, 1, 1}, [](const Vec3& p) {
    const double wall = std::exp(-0.5 * (p.z - 42) * (p.z - 42)), side = 9;
    const double in_wall =
        std::clamp(side - std::max(std::abs(p.x - 14), std::abs(p.y - 14)), 0.0, 1.0);
    const double window = 0.7 * std::exp(-(std::pow(p.x - 14, 2) + std::pow(p.y - 14, 2)) / 12);
    return 50 + 1150 * blurred_ball(norm(p - Vec3{14, 14, 14}), 8, 0.7) +
           400 * blurred_ball(norm(p - Vec3{40, 14, 14}), 8, 0.7) +
           600 * blurred_ball(norm(p - Vec3{40, 14, 14}), 1.5, 0.7) +
           1000 * in_wall * wall * (1 - window);
  });
  scan.modality = "CT";
  return scan;
}

TEST(Choose, ClosesFaintWindowsInThinBone) {
  const Volume scan = bones_with_a_window();
  Settings settings;
  const ChosenImage closed = choose(scan, settings);
  ASSERT_TRUE(closed.chosen.measured.has_local_levels());
  EXPECT_EQ(closed.chosen.measured.closed_tunnels, 1);
  settings.keep_topology = true;
  const ChosenImage open = choose(scan, settings);
  EXPECT_EQ(open.chosen.measured.closed_tunnels, 0);
  const double level = open.chosen.parameters.level;
  EXPECT_LT(open.restored.at(14, 14, 42), level);
  EXPECT_GT(closed.restored.at(14, 14, 42), level);
  // Image and level part by as much: written fields get back what the image was given.
  for (std::size_t n = 0; n < scan.samples.size(); ++n) {
    ASSERT_NEAR(closed.restored.samples[n] + closed.excess.samples[n],
                open.restored.samples[n] + open.excess.samples[n], 1e-3);
    ASSERT_LE(closed.excess.samples[n], open.excess.samples[n]);
  }
  settings.keep_topology = false;
  settings.local_level = false;
  EXPECT_TRUE(choose(scan, settings).excess.samples.empty());
}

/// A shell in the noise of a reconstruction, which undoing the blur raises beyond what is measured.
Volume shell_in_shared_noise(float deviation) {
  std::mt19937 generator(3);
  std::normal_distribution<float> white(0, deviation);
  Volume scan =
      sampled_volume({64, 64, 64}, {1, 1, 1}, [&](const Vec3&) { return white(generator); });
  scan = gaussian_smoothed(std::move(scan), 0.6);
  const Volume shell = sampled_volume({64, 64, 64}, {1, 1, 1}, [](const Vec3& p) {
    const double r = norm(p - Vec3{31, 32, 33});
    return 50 + 950 * (blurred_ball(r, 9, 0.9) - blurred_ball(r, 4, 0.9));
  });
  for (std::size_t n = 0; n < scan.samples.size(); ++n) scan.samples[n] += shell.samples[n];
  scan.modality = "CT";
  return scan;
}

TEST(Choose, FindsOneLevelWhereUndoingTheBlurRaisesTheNoise) {
  for (const float deviation : {20.0F, 60.0F, 140.0F}) {
    const Chosen chosen = choose(shell_in_shared_noise(deviation), {}).chosen;
    EXPECT_GT(chosen.measured.noise_left, 1.2 * chosen.parameters.noise) << deviation;
    EXPECT_FALSE(chosen.measured.has_local_levels()) << deviation;
    EXPECT_EQ(chosen.measured.closed_tunnels, 0) << deviation;
  }
}

TEST(ChooseFromPart, ChoosesAllButTheCells) {
  const Volume scan = ball();
  const Parameters whole = choose(scan, Settings{}).chosen.parameters;
  const Chosen all = choose_from_part(scan, scan, Settings{}).chosen;
  EXPECT_EQ(all.parameters.level, whole.level);
  EXPECT_EQ(all.parameters.functional.gamma, whole.functional.gamma);
  EXPECT_GT(whole.max_tets, 0);
  EXPECT_EQ(all.parameters.max_tets, 0);
  // From a part of it; but what follows from the grid is that of the whole.
  const Chosen part =
      choose_from_part(crop(scan, {{0, 0, 8}, {-1, -1, 30}}), scan, Settings{}).chosen;
  EXPECT_EQ(part.parameters.h_max, whole.h_max);
  EXPECT_EQ(part.parameters.unit_mm, whole.unit_mm);
  EXPECT_NEAR(part.parameters.level, whole.level, 3);
  EXPECT_NEAR(part.parameters.noise, whole.noise, 1);
}

TEST(CellsOfImage, CountNothingThinInNoise) {
  const Volume scan = ball();
  const double usual = cells_of_image(scan, {175, 110, 8}, 0);
  EXPECT_EQ(usual, cells_of_image(scan, {175, 110, 0}, 0));
  EXPECT_LT(cells_of_image(scan, {175, 110, 50}, 0), usual);
  EXPECT_EQ(cells_of_image(scan, {175, 110, 0}, 0.05), 2 * usual);
}

TEST(ChooseMaxTets, KeepsToItsBoundsAndToWhatIsGiven) {
  const auto chosen = [](double cells, Index slabs) {
    Parameters p;
    choose_max_tets(p, cells, slabs);
    return p.max_tets;
  };
  EXPECT_EQ(chosen(100, 1), kFewestTets);
  EXPECT_EQ(chosen(123'456.4, 1), 123'456);
  EXPECT_EQ(chosen(1e9, 1), kMostTets);
  EXPECT_EQ(chosen(1e9, 3), 3 * kMostTets);
  Parameters given;
  given.max_tets = 77;
  choose_max_tets(given, 1e6);
  EXPECT_EQ(given.max_tets, 77);
  Parameters preview;
  preview.preview = true;
  choose_max_tets(preview, 1e6);
  EXPECT_EQ(preview.max_tets, 0);
}

TEST(ChooseTolerance, FollowsTheErrorWithinBounds) {
  const auto chosen = [](Parameters p, double error, double errors) {
    choose_tolerance(p, 0.5, error, errors);
    return *p.tolerance;
  };
  EXPECT_EQ(chosen({}, 0.02, 1), 0.02);
  EXPECT_EQ(chosen({}, 0.02, 2), 0.04);
  EXPECT_EQ(chosen({}, 0, 1), 0.0168 * 0.5);
  EXPECT_EQ(chosen({}, 1, 1), 0.056 * 0.5);
  EXPECT_EQ(chosen({}, 1, kErrorsOfPreview), 0);
  Parameters p;
  p.accuracy = 0.2;
  EXPECT_EQ(chosen(p, 1, 2), 0.1);
  EXPECT_EQ(chosen(p, 0, kErrorsOfPreview), 0.1) << "also of a preview";
  p.accuracy = 1e-6;
  EXPECT_EQ(chosen(p, 1, 2), 0.01 * 0.5);
  p.triangles = 500;
  EXPECT_TRUE(std::isinf(chosen(p, 1, 1)));
  EXPECT_TRUE(std::isinf(chosen(p, 0, kErrorsOfPreview)));
  p.tolerance = 0.3;
  EXPECT_EQ(chosen(p, 1, 1), 0.3);
}

}  // namespace
}  // namespace mesamis
