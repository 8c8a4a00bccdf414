// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/local_level.h"

#include <gtest/gtest.h>

#include <random>

#include "mesamis/base/parallel.h"
#include "mesamis/image/trilinear.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

constexpr double kAround = 50, kDense = 1200, kLight = 350, kBall = 9, kBlur = 0.8;
const Vec3 kDenseCentre{14, 14, 14}, kLightCentre{46, 14, 14};
const ObjectContrast kOfDense{kAround, kDense, 1000};
constexpr double kHalfMaximum = (kAround + kDense) / 2;

/// Two balls, of which one is less dense but for a grain in its middle, which is as dense as asked for.
Volume two_balls(double light = kLight, double grain = kDense) {
  return sampled_volume({61, 29, 29}, {1, 1, 1}, [&](const Vec3& p) {
    const auto ball = [&p](const Vec3& centre, double radius) {
      return blurred_ball(norm(p - centre), radius, kBlur);
    };
    return kAround + (kDense - kAround) * ball(kDenseCentre, kBall) +
           (light - kAround) * ball(kLightCentre, kBall) +
           (grain - light) * ball(kLightCentre, 1.5);
  });
}

TEST(LocalLevel, IsMidwayBetweenTheSidesOfTheEdgeNearby) {
  const LocalLevel local = find_local_level(two_balls(), kOfDense, kHalfMaximum, {});
  for (const Vec3& way : {Vec3{0, 1, 0}, Vec3{0, 0, -1}, Vec3{0, 0.6, 0.8}}) {
    const double dense = Trilinear(local.excess).at(kDenseCentre + kBall * way);
    const double light = Trilinear(local.excess).at(kLightCentre + kBall * way);
    EXPECT_NEAR(kHalfMaximum + dense, kHalfMaximum, 0.03 * (kDense - kAround));
    EXPECT_NEAR(kHalfMaximum + light, (kAround + kLight) / 2, 0.06 * (kLight - kAround));
  }
  EXPECT_NEAR(local.range[0], (kAround + kLight) / 2, 0.1 * (kLight - kAround));
  EXPECT_NEAR(local.range[1], kHalfMaximum, 0.03 * (kDense - kAround));
}

TEST(LocalLevel, TakenOffMakesTheObjectsLevelThatOfEachPlace) {
  Volume scan = two_balls();
  take_off(find_local_level(scan, kOfDense, kHalfMaximum, {}).excess, scan);
  const Vec3 middle{0, middle_radius(kBall, kBlur), 0};
  EXPECT_NEAR(Trilinear(scan).at(kLightCentre + middle), kHalfMaximum, 0.07 * (kLight - kAround));
  EXPECT_GT(Trilinear(scan).at(kLightCentre + Vec3{0, kBall - 2, 0}), kHalfMaximum);
  EXPECT_LT(Trilinear(scan).at(kLightCentre + Vec3{0, kBall + 2, 0}), kHalfMaximum);
}

/// Ears and vessels have edges, and are no bone.
TEST(LocalLevel, PartsThatNowhereReachTheObjectsLevelKeepIt) {
  Volume scan = two_balls(kLight, kLight);
  const LocalLevel local = find_local_level(scan, kOfDense, kHalfMaximum, {});
  EXPECT_LT(local.range[0], 0.5 * kHalfMaximum);
  take_off(local.excess, scan);
  for (Index i = 30; i < 61; ++i) ASSERT_LT(scan.at(i, 14, 14), kHalfMaximum);
  EXPECT_GT(scan.at(14, 14, 14), kHalfMaximum);
}

/// What a gap of one voxel parts belongs together: so do the shreds of a thin plate.
TEST(LocalLevel, PartsBesideOneThatReachesHaveTheirOwnLevel) {
  const double nearly = 0.95 * kHalfMaximum;
  const auto in_reach = [nearly](double gap) {
    const Vec3 light{kDenseCentre.x + 2 * kBall + gap, 14, 14};
    Volume scan = sampled_volume({61, 29, 29}, {1, 1, 1}, [&](const Vec3& p) {
      return kAround + (kDense - kAround) * blurred_ball(norm(p - kDenseCentre), kBall, kBlur) +
             (nearly - kAround) * blurred_ball(norm(p - light), kBall, kBlur);
    });
    take_off(find_local_level(scan, kOfDense, kHalfMaximum, {}).excess, scan);
    return Trilinear(scan).at(light) > kHalfMaximum;
  };
  EXPECT_TRUE(in_reach(1));
  EXPECT_FALSE(in_reach(6));
}

/// The blur keeps a thin wall from its own value: what is thick nearby tells its level.
TEST(LocalLevel, ThinWallsAndNoiseHaveNoSay) {
  std::mt19937 generator(2);
  std::normal_distribution<double> noise(0, 60);
  const Volume wall = sampled_volume({40, 20, 20}, {1, 1, 1}, [](const Vec3& p) {
    return kAround + (kDense - kAround) * std::exp(-(p.x - 20) * (p.x - 20) / 2);
  });
  const Volume nothing = sampled_volume({30, 30, 30}, {1, 1, 1},
                                        [&](const Vec3&) { return kAround + noise(generator); });
  for (const LocalLevel& local : {find_local_level(wall, kOfDense, kHalfMaximum, {}),
                                  find_local_level(nothing, kOfDense, kHalfMaximum, {60})}) {
    EXPECT_EQ(local.edge_share, 0);
    EXPECT_TRUE(local.excess.samples.empty());
  }
}

/// A small object in much noise: the noise has more voxels for its extremes than the object has edges.
TEST(LocalLevel, NoiseAroundASmallObjectHasNoSay) {
  for (const double deviation : {30.0, 45.0, 60.0}) {
    std::mt19937 generator(5);
    std::normal_distribution<double> noise(0, deviation);
    const Vec3 centre{40, 40, 40};
    const Volume scan = sampled_volume({81, 81, 81}, {1, 1, 1}, [&](const Vec3& p) {
      return kAround + (kDense - kAround) * blurred_ball(norm(p - centre), 5, kBlur) +
             noise(generator);
    });
    const LocalLevel local = find_local_level(scan, kOfDense, kHalfMaximum, {deviation});
    EXPECT_GT(local.edge_share, 0) << deviation;
    EXPECT_TRUE(local.excess.samples.empty()) << deviation;
  }
}

TEST(LocalLevel, IsOneWhereTheDensitiesScatterAsThoseOfOneObject) {
  const double light = kDense - 0.15 * (kDense - kAround);
  const LocalLevel one = find_local_level(two_balls(light, light), kOfDense, kHalfMaximum, {});
  EXPECT_GT(one.edge_share, 0);
  EXPECT_TRUE(one.excess.samples.empty());
  EXPECT_EQ(one.range[0], one.range[1]);
}

/// A part of a scan takes the share of the whole.
TEST(LocalLevel, CountsByTheShareThatIsKnown) {
  const Volume scan = two_balls();
  const LocalLevel found = find_local_level(scan, kOfDense, kHalfMaximum, {});
  EXPECT_EQ(found.share, 1);
  const LocalLevel half = find_local_level(scan, kOfDense, kHalfMaximum, {.share = 0.5});
  EXPECT_EQ(half.share, 0.5);
  EXPECT_NEAR(half.range[0] - kHalfMaximum, 0.5 * (found.range[0] - kHalfMaximum), 1);
  const LocalLevel none = find_local_level(scan, kOfDense, kHalfMaximum, {.share = 0});
  EXPECT_TRUE(none.excess.samples.empty());
}

TEST(LocalLevel, HasTheSameBitsForAnyNumberOfThreads) {
  const Volume scan = two_balls();
  const auto run = [&] {
    return find_local_level(scan, kOfDense, kHalfMaximum, {}).excess.samples;
  };
  EXPECT_EQ(with_threads(1, run), with_threads(3, run));
}

}  // namespace
}  // namespace mesamis
