// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/label_choice.h"

#include <gtest/gtest.h>

#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

const Vec3 kMiddle{14, 14, 14};

/// A ball of 90 to 400 HU in soft tissue, with a lung of -800 HU in a corner.
Volume scan_with_ball() {
  Volume scan = sampled_volume({40, 28, 28}, {1, 1, 1}, [](const Vec3& p) {
    return 40 + 360 * blurred_ball(norm(p - kMiddle), 7, 0.9) -
           840 * blurred_ball(norm(p - Vec3{32, 20, 20}), 5, 0.9);
  });
  scan.modality = "CT";
  return scan;
}

/// 1: the ball, 2: the lung.
LabelMap labels_of_scan() {
  LabelMap map{scan_with_ball(), {{}}, {{"ball", 1, 0, {}}, {"lung", 2, 0, {}}}};
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    const auto [i, j, k] = map.voxel(n);
    const Vec3 p{1.0 * i, 1.0 * j, 1.0 * k};
    map.layers[0].push_back(norm(p - kMiddle) < 7 ? 1 : norm(p - Vec3{32, 20, 20}) < 5 ? 2 : 0);
  }
  return map;
}

TEST(LabelChoice, ValuesAreThoseOfTheChosenLabels) {
  const LabelMap map = labels_of_scan();
  const Volume scan = scan_with_ball();
  const LabelBlock all{{0, 0, 0}, map.size};
  const auto values = [&](const std::vector<Segment>& chosen) {
    return values_of_labels(scan, {map, all, chosen});
  };
  const LabelledValues ball = values({map.segments[0]});
  EXPECT_NEAR(ball.medians.low, 400, 20);
  EXPECT_EQ(ball.medians.low, ball.medians.high);
  ASSERT_TRUE(ball.level);
  EXPECT_NEAR(*ball.level, (40 + 400) / 2, 10);
  const LabelledValues both = values(map.segments);
  EXPECT_NEAR(both.medians.low, -750, 60);
  EXPECT_EQ(both.medians.high, ball.medians.high);
  Volume even = scan;
  even.samples.assign(even.samples.size(), 7);
  EXPECT_FALSE(values_of_labels(even, {map, all, map.segments}).level);
}

/// What the scan is restored by is its own, whichever labels are chosen.
TEST(LabelChoice, IsThatOfTheScan) {
  const Volume scan = scan_with_ball();
  const Chosen one = choose_beside_labels(scan, Settings{}, {220, {350, 350}});
  const Chosen other = choose_beside_labels(scan, Settings{}, {100, {50, 350}});
  const Parameters &p = one.parameters, &q = other.parameters;
  EXPECT_GT(p.blur[0], 0.5);
  EXPECT_EQ(p.blur, q.blur);
  EXPECT_EQ(p.noise, q.noise);
  EXPECT_EQ(p.grey.low, q.grey.low);
  EXPECT_EQ(p.grey.high, q.grey.high);
  EXPECT_EQ(one.object.level, other.object.level);
  EXPECT_EQ(p.level, 220);
  EXPECT_EQ(q.level, 100);
  Settings settings;
  settings.level = 180;
  EXPECT_EQ(choose_beside_labels(scan, settings, {220, {350, 350}}).parameters.level, 180);
}

/// The usual window of CT begins at -200 HU: the edge of a lung would be cut off.
TEST(LabelChoice, TheWindowHoldsWhatLabelsCover) {
  const Volume scan = scan_with_ball();
  const GreyMap usual = choose_beside_labels(scan, Settings{}, {220, {400, 400}}).parameters.grey;
  EXPECT_EQ(usual.low, -200);
  const GreyMap wide = choose_beside_labels(scan, Settings{}, {0, {-800, 400}}).parameters.grey;
  EXPECT_EQ(wide.low, -800);
  EXPECT_EQ(wide.high, usual.high);
  Settings settings;
  settings.window = Window{-100, 500};
  EXPECT_EQ(choose_beside_labels(scan, settings, {0, {-800, 400}}).parameters.grey.low, -100);
}

TEST(LabelChoice, LabelsWithoutAnEdgeAreNotRefused) {
  Volume scan = scan_with_ball();
  scan.samples.assign(scan.samples.size(), 7);
  scan.samples[0] = 8;
  EXPECT_FALSE(choose_beside_labels(scan, Settings{}, {}).measured.contrast > 0);
}

}  // namespace
}  // namespace mesamis
