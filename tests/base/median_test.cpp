// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/median.h"

#include <gtest/gtest.h>

#include <random>

namespace mesamis {
namespace {

TEST(Median, IsTheMiddleOfTheSortedValues) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-5, 5);
  for (const std::size_t count : {1u, 2u, 3u, 10u, 101u}) {
    std::vector<double> values(count);
    for (double& x : values) x = uniform(generator);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(median(values), sorted[count / 2]);
  }
}

TEST(Median, OfAnEvenCountIsTheUpperOfTheTwo) {
  std::vector<double> values{4, 1, 3, 2};
  EXPECT_EQ(median(values), 3);
}

}  // namespace
}  // namespace mesamis
