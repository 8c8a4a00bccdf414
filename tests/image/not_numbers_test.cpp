// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/not_numbers.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace mesamis {
namespace {

TEST(NotNumbers, BecomeTheLeastOfTheOthers) {
  std::vector<float> samples{3, NAN, -2, NAN, 7};
  const NotNumbers found = fill_not_numbers(samples);
  EXPECT_EQ(found.voxels, 2u);
  EXPECT_EQ(found.filled, -2);
  EXPECT_THAT(samples, testing::ElementsAre(3, -2, -2, -2, 7));
}

TEST(NotNumbers, StayWhereThereIsNothingElse) {
  std::vector<float> none{1, INFINITY}, all{NAN, NAN}, empty;
  EXPECT_EQ(fill_not_numbers(none).voxels, 0u);
  EXPECT_THAT(none, testing::ElementsAre(1, INFINITY));
  EXPECT_EQ(fill_not_numbers(all).voxels, 0u);
  EXPECT_TRUE(std::isnan(all[0]));
  EXPECT_EQ(fill_not_numbers(empty).voxels, 0u);
}

}  // namespace
}  // namespace mesamis
