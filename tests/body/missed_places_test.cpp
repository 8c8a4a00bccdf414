// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/missed_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace mesamis {
namespace {

/// The cube's top, 1 above the slab's, is farther than the tolerance; its lower parts are not.
TEST(MissedPlaces, AreThoseFartherThanTheTolerance) {
  constexpr double kTolerance = 0.4;
  const TriMesh slab = brick({{-5, -5, -1}, {6, 6, 0}}, {4, 4, 2}), on_it = cube();
  const auto places = detail::body::missed_places(on_it, slab, kTolerance);
  double highest = 0, lowest = 1;
  for (const Vec3& p : places) {
    highest = std::max(highest, p.z);
    lowest = std::min(lowest, p.z);
  }
  EXPECT_EQ(highest, 1);
  EXPECT_GT(lowest, 0.85 * kTolerance);
  EXPECT_LT(lowest, 1.25 * kTolerance);
  // The top alone is covered by points a quarter of the tolerance apart.
  EXPECT_GT(places.size(), 1 / std::pow(0.25 * kTolerance, 2));
}

TEST(MissedPlaces, AreNoneWithinTheTolerance) {
  const TriMesh slab = brick({{-5, -5, -1}, {6, 6, 0}}, {4, 4, 2});
  EXPECT_TRUE(detail::body::missed_places(cube(), slab, 1.001).empty());
  EXPECT_FALSE(detail::body::missed_places(cube(), slab, 0.999).empty());
}

TEST(MissedPlaces, AreTheSameForAnyNumberOfThreads) {
  const TriMesh inner = ball_surface(9, 64), outer = ball_surface(10, 64);
  auto find = [&] { return detail::body::missed_places(outer, inner, 0.5); };
  const auto once = with_threads(1, find), again = with_threads(4, find);
  ASSERT_EQ(once.size(), again.size());
  ASSERT_FALSE(once.empty());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(norm(once[i] - again[i]), 0);
}

}  // namespace
}  // namespace mesamis
