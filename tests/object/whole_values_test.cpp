// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/whole_values.h"

#include <gtest/gtest.h>

#include <cmath>

#include "object/object_scenes.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

Volume ball(double inside, double core) {
  return sampled_volume({30, 28, 26}, {1, 1, 1}, [=](const Vec3& p) {
    const double r = norm(p - Vec3{14, 14, 13});
    return r < 4 ? core : r < 9 ? inside : 0;
  });
}

TEST(FewWholeValues, AreThoseOfMasksAndLabelMaps) {
  const auto mask = find_few_whole_values(ball(1, 1));
  ASSERT_TRUE(mask);
  EXPECT_EQ(mask->count, 2u);
  EXPECT_EQ(mask->least, 0);
  EXPECT_EQ(mask->most, 1);
  EXPECT_EQ(find_few_whole_values(ball(255, 255))->most, 255);
  EXPECT_EQ(find_few_whole_values(ball(1, 700))->count, 3u);
}

TEST(FewWholeValues, AreNotThoseOfScans) {
  Volume noisy = ball(100, 200);
  add_noise(noisy, 8);
  EXPECT_FALSE(find_few_whole_values(noisy)) << "fractions";
  for (float& x : noisy.samples) x = std::round(x);
  EXPECT_FALSE(find_few_whole_values(noisy)) << "neighbours differ";
  EXPECT_FALSE(find_few_whole_values(ball(0.5, 1)));
  EXPECT_FALSE(find_few_whole_values(ball(0, 0))) << "one value";
  EXPECT_FALSE(find_few_whole_values(ball(-1000, 1000))) << "negative";
  EXPECT_FALSE(find_few_whole_values(Volume{}));
  const Volume ramp =
      sampled_volume({60, 50, 40}, {1, 1, 1}, [](const Vec3& p) { return p.x + 60 * p.y; });
  EXPECT_FALSE(find_few_whole_values(ramp)) << "too many";
}

}  // namespace
}  // namespace mesamis
