// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/probable_memberships.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"
#include "support/partition_laws.h"

namespace mesamis {
namespace {

constexpr Index kSide = 20;
const Vec3 kMiddle{9.3, 9.8, 9.6};
constexpr double kRadius = 6;

/// Two halves of a ball that meet at x = 9.3: probabilities that fall over two voxels.
Probabilities halves() {
  Probabilities all{{.size = {kSide, kSide, kSide}}, {}, {}};
  all.segments = {{"left", 1, 0, {}}, {"right", 2, 1, {}}};
  all.layers.resize(2);
  const auto ramp = [](double depth) { return std::clamp(0.5 + depth / 2, 0.0, 1.0); };
  for (Index k = 0; k < kSide; ++k) {
    for (Index j = 0; j < kSide; ++j) {
      for (Index i = 0; i < kSide; ++i) {
        const Vec3 p{double(i), double(j), double(k)};
        const double ball = ramp(kRadius - norm(p - kMiddle)), right = ramp(p.x - kMiddle.x);
        all.layers[0].push_back(static_cast<float>(ball * (1 - right)));
        all.layers[1].push_back(static_cast<float>(ball * right));
      }
    }
  }
  return all;
}

TEST(ProbableMemberships, PutTheBoundaryBetweenTheVoxels) {
  const Probabilities from = halves();
  const PartitionSurface partition = extract_partition_on_grid(probable_memberships(from, from));
  int between = 0;
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    const auto& sides = partition.sides[t];
    if (sides != std::array<Index, 2>{1, 2}) continue;
    for (const Index p : partition.triangles[t]) {
      if (norm(partition.points[static_cast<std::size_t>(p)] - kMiddle) > kRadius - 2) continue;
      EXPECT_NEAR(partition.points[static_cast<std::size_t>(p)].x, kMiddle.x, 1e-4);
      ++between;
    }
  }
  EXPECT_GT(between, 100);
}

TEST(ProbableMemberships, MakeClosedObjectsThatShareTheirBoundaries) {
  const Probabilities from = halves();
  const double box = std::pow(kSide - 1, 3);
  expect_partition_laws(extract_partition_on_grid(probable_memberships(from, from)), box, "halves");
}

TEST(ProbableMemberships, WinnersAreTheMostProbable) {
  const Probabilities from = halves();
  const GridMemberships found = probable_memberships(from, from);
  EXPECT_EQ(winning_labels(found), most_probable(from).layers[0]);
}

TEST(ProbableMemberships, AreBackgroundBeyondTheirVoxels) {
  const Probabilities from = halves();
  VoxelGrid far = from;
  far.origin = {100, 0, 0};
  const GridMemberships found = probable_memberships(from, far);
  EXPECT_TRUE(std::all_of(found.material.begin(), found.material.end(),
                          [](Index material) { return material == 0; }));
}

TEST(ProbableMemberships, AreTheSameForAnyNumberOfThreads) {
  const Probabilities from = halves();
  const auto one = with_threads(1, [&] { return probable_memberships(from, from); });
  const auto two = with_threads(2, [&] { return probable_memberships(from, from); });
  EXPECT_EQ(one.material, two.material);
  EXPECT_EQ(one.value, two.value);
}

}  // namespace
}  // namespace mesamis
