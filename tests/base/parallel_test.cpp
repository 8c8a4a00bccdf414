// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/parallel.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
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

std::size_t leaves_below(std::size_t items) {
  if (items == 1) return 1;
  std::array<std::size_t, 2> leaves{};
  parallel_halves(items, [&](std::size_t half) {
    leaves[half] = leaves_below(half == 0 ? items / 2 : items - items / 2);
  });
  return leaves[0] + leaves[1];
}

TEST(Parallel, HalvesOfARecursionAreVisitedOnce) {
  for (const std::size_t items : {1, 2, 7, 300'001}) EXPECT_EQ(leaves_below(items), items);
}

TEST(Parallel, SumHasTheSameBitsForAnyNumberOfThreads) {
  std::vector<double> sums;
  for (const int threads : {1, 2, 3, 8}) {
    sums.push_back(with_threads(threads, [&] {
      EXPECT_EQ(thread_count(), threads);
      return parallel_sum(1'000'003, harmonic_sum);
    }));
  }
  for (const double sum : sums) EXPECT_EQ(sum, sums[0]);
  EXPECT_NEAR(sums[0], std::log(1'000'003.0) + 0.5772156649, 1e-5);
}

TEST(Parallel, ThreadsAreLimitedOnlyWithinTheWork) {
  const int outside = thread_count();
  const int inside = with_threads(outside + 2, [&] {
    EXPECT_EQ(with_threads(1, [] { return thread_count(); }), 1);
    EXPECT_EQ(with_threads(0, [] { return thread_count(); }), outside + 2);
    return thread_count();
  });
  EXPECT_EQ(inside, outside + 2);
  EXPECT_EQ(thread_count(), outside);
  EXPECT_THROW(with_threads(1, [] { throw 1; }), int);
  EXPECT_EQ(thread_count(), outside);
}

TEST(Parallel, TasksShareTheThreads) {
  for (const auto& [threads, at_once, least, most] : std::vector<std::array<int, 4>>{
           {1, 4, 1, 1}, {6, 1, 6, 6}, {6, 2, 3, 3}, {6, 4, 1, 2}, {3, 9, 1, 1}}) {
    std::vector<int> visits(7, 0);
    std::vector<double> sums(7);
    with_threads(threads, [&, at_once = at_once, least = least, most = most] {
      parallel_tasks(visits.size(), at_once, [&](std::size_t i) {
        ++visits[i];
        EXPECT_GE(thread_count(), least);
        EXPECT_LE(thread_count(), most);
        sums[i] = parallel_sum(100'003, harmonic_sum);
      });
    });
    EXPECT_EQ(visits, std::vector<int>(7, 1));
    for (const double sum : sums) EXPECT_EQ(sum, sums[0]);
  }
}

TEST(Parallel, ATaskThatFailsLeavesTheOthersWhole) {
  std::atomic<bool> has_begun = false, has_failed = false;
  double sum = 0;
  const auto work = [&](std::size_t i) {
    if (i == 0) {
      while (!has_begun) std::this_thread::yield();
      has_failed = true;
      throw 1;
    }
    has_begun = true;
    while (!has_failed) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    sum = parallel_sum(1'000'003, harmonic_sum);
  };
  with_threads(4, [&] { EXPECT_THROW(parallel_tasks(2, 2, work), int); });
  EXPECT_EQ(sum, parallel_sum(1'000'003, harmonic_sum));
}

TEST(Parallel, CollectsInTheOrderOfTheItems) {
  std::vector<std::size_t> expected;
  for (std::size_t i = 0; i < 10'001; ++i) {
    if (i % 7 == 3) expected.push_back(i);
  }
  const auto sevenths = [](std::size_t begin, std::size_t end, std::vector<std::size_t>& found) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i % 7 == 3) found.push_back(i);
    }
  };
  for (const std::size_t block : {1u, 5u, 4096u, 20'000u}) {
    EXPECT_EQ(
        with_threads(3, [&] { return parallel_collect<std::size_t>(10'001, block, sevenths); }),
        expected);
  }
  EXPECT_TRUE(parallel_collect<std::size_t>(0, 5, sevenths).empty());
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
