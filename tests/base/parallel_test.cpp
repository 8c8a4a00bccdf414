// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mesamis {
namespace {

double harmonic_sum(std::size_t begin, std::size_t end) {
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += 1 / (1.0 + static_cast<double>(i));
  return sum;
}

TEST(Parallel, VisitsEveryItemOnce) {
  std::vector<int> visits(100'003, 0);
  parallel_for(visits.size(), [&](std::size_t i) { ++visits[i]; });
  for (const int count : visits) ASSERT_EQ(count, 1);
}

TEST(Parallel, SumHasTheSameBitsForAnyNumberOfThreads) {
  std::vector<double> sums;
  for (const int threads : {1, 2, 3, 8}) {
    set_thread_count(threads);
    EXPECT_EQ(thread_count(), threads);
    sums.push_back(parallel_sum(1'000'003, harmonic_sum));
  }
  set_thread_count(0);
  for (const double sum : sums) EXPECT_EQ(sum, sums[0]);
  EXPECT_NEAR(sums[0], std::log(1'000'003.0) + 0.5772156649, 1e-5);
}

TEST(Parallel, MaxOfNothingIsTheLowest) {
  auto never = [](std::size_t, std::size_t) { return 7.0; };
  EXPECT_EQ(parallel_max(0, -3, never), -3);
  EXPECT_EQ(parallel_max(1, -3, never), 7);
}

TEST(Parallel, AnExceptionReachesTheCaller) {
  EXPECT_THROW(parallel_for_each(64,
                                 [](std::size_t i) {
                                   if (i == 63) throw 1;
                                 }),
               int);
}

}  // namespace
}  // namespace mesamis
