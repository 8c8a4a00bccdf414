// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "mesamis/base/parallel.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

class Rank : public Team {
 public:
  Rank(int size, int rank) : size_(size), rank_(rank) {}
  int size() const noexcept override { return size_; }
  int rank() const noexcept override { return rank_; }
  void wait_for_all() override { ++waits; }
  int waits = 0;

 private:
  int size_, rank_;
};

class StagesAlone : public testing::Test {
 protected:
  const TempFolder folder;
  const Scratch scratch{folder.path()};
  const Progress progress;
  Alone team;
  Stages stages{scratch, team, progress, 7};
};

TEST(Stages, EachTaskIsDoneByOneProcessOnce) {
  const TempFolder folder;
  const Scratch scratch(folder.path());
  std::vector<int> done(7, 0);
  for (int turn = 0; turn < 2; ++turn) {  // again, as after a run that was killed
    for (int rank = 0; rank < 3; ++rank) {
      Rank team(3, rank);
      const Progress progress;
      Stages stages(scratch, team, progress, 7);
      stages.run("work", 7, [&](Index n) {
        ++done[static_cast<std::size_t>(n)];
        return SlabWork{.rows = 10 + n};
      });
      EXPECT_EQ(team.waits, 1);
      if (rank == 2) {
        EXPECT_EQ(stages.work_of("work", 3).rows, 13);
      }
    }
  }
  EXPECT_EQ(done, std::vector<int>(7, 1));
}

/// Each slab counts its own tasks and those of the border above it.
TEST_F(StagesAlone, SumTheWorkOfSlabs) {
  stages.run("look", 3, [](Index) { return SlabWork{.rows = 10000}; });
  stages.for_slabs("mesh", 3, [](Index s) { return SlabWork{.rows = 10 * (s + 1)}; });
  stages.for_borders("seam", 3, [](Index s) { return SlabWork{.rows = s + 1}; });
  std::vector<std::int64_t> rows;
  for (const SlabWork& work : stages.work_of_slabs(3)) rows.push_back(work.rows);
  EXPECT_EQ(rows, (std::vector<std::int64_t>{11, 22, 30}));
}

TEST(Stages, SomeTasksAreDoneAtATime) {
  const TempFolder folder;
  const Scratch scratch(folder.path());
  Alone team;
  for (const auto& [turns, at_once] : std::vector<std::pair<Index, int>>{{12, 1}, {5, 2}, {1, 4}}) {
    std::vector<double> told;
    const Progress progress = [&told](auto, double share) {
      told.push_back(share);
      return true;
    };
    Stages stages(scratch, team, progress, turns);
    std::atomic<int> now = 0, most = 0;
    with_threads(4, [&] {
      stages.run("turns " + std::to_string(turns), 12, [&](Index) {
        const int with_me = ++now;
        for (int seen = most; seen < with_me && !most.compare_exchange_weak(seen, with_me);) {
        }
        EXPECT_EQ(thread_count(), 4 / at_once);
        for (int wait = 0; most < at_once && wait < 1000; ++wait) {  // for the others
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        --now;
        return SlabWork{};
      });
    });
    EXPECT_EQ(most, at_once) << "as many as may be in memory";
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 1);
  }
}

TEST_F(StagesAlone, ATaskThatFailsIsDoneAgain) {
  int calls = 0;
  const auto fails_once = [&](Index) {
    if (++calls == 2) throw std::runtime_error("no more");
    return SlabWork{};
  };
  EXPECT_THROW(stages.run("work", 3, fails_once), std::runtime_error);
  stages.run("work", 3, fails_once);
  EXPECT_EQ(calls, 4) << "the first is not done again";
}

}  // namespace
}  // namespace mesamis
