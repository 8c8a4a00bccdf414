// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/point_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mesamis {
namespace {

TEST(PointNumbers, CountPointsThatDifferByABit) {
  PointNumbers numbers;
  const Vec3 p{1, 2, 3}, q{1, 2, std::nextafter(3.0, 4.0)};
  EXPECT_EQ(numbers.of(p).number, 0);
  EXPECT_TRUE(numbers.of(q).is_new);
  EXPECT_EQ(numbers.of(q).number, 1);
  EXPECT_FALSE(numbers.of(p).is_new);
  EXPECT_EQ(numbers.find(q), 1);
  EXPECT_EQ(numbers.find({1, 2, 4}), kNoIndex);
}

TEST(PointNumbers, TakeBothZerosForOne) {
  PointNumbers numbers;
  (void)numbers.of({0.0, -0.0, 1});
  EXPECT_EQ(numbers.find({-0.0, 0.0, 1}), 0);
}

}  // namespace
}  // namespace mesamis
