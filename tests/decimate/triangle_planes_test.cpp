// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/triangle_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mesamis {
namespace {

TEST(TrianglePlanes, GiveTheDistanceOfATriangle) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto somewhere = [&] {
    return Vec3{uniform(generator), uniform(generator), uniform(generator)};
  };
  for (int n = 0; n < 3000; ++n) {
    const Corners t{somewhere(), somewhere(), n % 10 == 0 ? Vec3{0, 0, 0} : somewhere()};
    const TrianglePlanes planes(t);
    const Vec3 p = somewhere();
    const double expected = squared_distance(p, t);
    EXPECT_NEAR(planes.squared_distance_up_to(100, p), expected, 1e-9);
    const double most = 0.1, found = planes.squared_distance_up_to(most, p);
    if (expected <= most) {
      EXPECT_NEAR(found, expected, 1e-9);
    } else {
      EXPECT_GT(found, most);
    }
    const Corners other{p, p + 0.2 * somewhere(), p + 0.2 * somewhere()};
    if (planes.is_beyond(other, 0.3)) {
      EXPECT_GT(expected, 0.09);
    }
  }
}

TEST(TrianglePlanes, MeasureNeedlesAllTheSame) {
  const Corners needle{Vec3{0, 0, 0}, {1, 0, 0}, {0.5, 1e-12, 0}};
  const TrianglePlanes planes(needle);
  EXPECT_NEAR(planes.squared_distance_up_to(10, {0.5, 0, 2}), 4, 1e-9);
  EXPECT_NEAR(planes.squared_distance_up_to(10, {2, 0, 0}), 1, 1e-9);
}

}  // namespace
}  // namespace mesamis
