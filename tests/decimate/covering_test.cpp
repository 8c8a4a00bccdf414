// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/covering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/surface/farthest.h"
#include "support/level_set.h"

namespace mesamis {
namespace {

std::vector<const TrianglePlanes*> pointers_to(const std::vector<TrianglePlanes>& triangles) {
  std::vector<const TrianglePlanes*> pointers;
  for (const TrianglePlanes& t : triangles) pointers.push_back(&t);
  return pointers;
}

TEST(Covering, AgreesWithTheSearchForTheFarthestPoint) {
  const TriMesh sphere =
      level_set({{-1, -1, -1}, {1, 1, 1}}, {6, 6, 6}, [](const Vec3& p) { return 0.8 - norm(p); });
  std::vector<TrianglePlanes> all;
  for (const Triangle& t : sphere.triangles) all.emplace_back(corners_of(sphere, t));
  const auto others = pointers_to(all);
  const TriangleTree tree(sphere);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int proved = 0, missed = 0;
  for (int n = 0; n < 2000; ++n) {
    Corners t;
    const auto somewhere = [&] {
      const Vec3 p{uniform(generator), uniform(generator), uniform(generator)};
      return (0.8 + 0.05 * uniform(generator)) * unit_or_zero(p);
    };
    t[0] = somewhere();
    for (std::size_t i = 1; i < 3; ++i) {
      t[i] = t[0] + 0.3 * Vec3{uniform(generator), uniform(generator), uniform(generator)};
    }
    constexpr double kTolerance = 0.15;
    std::size_t hint = 0;
    const double true_bound = farthest_distance(t, tree, {1e-4, 1}, hint);
    Covering covering(kTolerance);
    const double bound = covering.bound(t, others);
    if (std::isfinite(bound)) {
      ++proved;
      EXPECT_LE(bound, kTolerance);
      EXPECT_GE(bound * kDistanceSlack + 1e-4, true_bound);
    } else if (true_bound < kTolerance / 1.1) {
      ++missed;
    }
  }
  EXPECT_GT(proved, 500);
  EXPECT_LT(missed, proved / 20) << "what is near is proved, but for some";
}

TEST(Covering, TellsWhatItUsed) {
  const Corners left{Vec3{0, 0, 0}, {2, 0, 0}, {0, 2, 0}},
      right{Vec3{2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, away{Vec3{9, 9, 0}, {10, 9, 0}, {9, 10, 0}};
  const std::vector<TrianglePlanes> all{TrianglePlanes(away), TrianglePlanes(left),
                                        TrianglePlanes(right)};
  Covering covering(0.1);
  const Corners inside{Vec3{0.2, 0.2, 0.05}, {0.8, 0.2, 0.05}, {0.2, 0.8, 0.05}};
  EXPECT_NEAR(covering.bound(inside, pointers_to(all)), 0.05, 1e-12);
  EXPECT_EQ(covering.used(), std::vector<Index>{1});
  const Corners across{Vec3{0.5, 0.5, 0}, {1.5, 0.5, 0}, {1.5, 1.5, 0}};
  EXPECT_NEAR(covering.bound(across, pointers_to(all)), 0, 0.1);
  for (const Index used : covering.used()) EXPECT_NE(used, 0);
  EXPECT_GE(covering.used().size(), 2u);
  const Corners beyond{Vec3{0.5, 0.5, 0}, {5, 0.5, 0}, {1.5, 1.5, 0}};
  EXPECT_TRUE(std::isinf(covering.bound(beyond, pointers_to(all))));
}

}  // namespace
}  // namespace mesamis
