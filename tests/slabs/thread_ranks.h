// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <barrier>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "mesamis/slabs/team.h"

namespace mesamis {

/// A rank that is a thread.
class ThreadRank : public Team {
 public:
  ThreadRank(std::barrier<>& barrier, int size, int rank)
      : barrier_(barrier), size_(size), rank_(rank) {}
  int size() const noexcept override { return size_; }
  int rank() const noexcept override { return rank_; }
  void wait_for_all() override { barrier_.arrive_and_wait(); }

 private:
  std::barrier<>& barrier_;
  int size_, rank_;
};

/// What a run returns on each of so many ranks.
template <class Result>
std::vector<std::optional<Result>> results_of_ranks(
    int size, const std::function<std::optional<Result>(Team&)>& run) {
  std::barrier barrier(size);
  std::vector<std::optional<Result>> results(static_cast<std::size_t>(size));
  std::vector<std::thread> ranks;
  for (int rank = 0; rank < size; ++rank) {
    ranks.emplace_back([&, rank] {
      ThreadRank team(barrier, size, rank);
      results[static_cast<std::size_t>(rank)] = run(team);
    });
  }
  for (std::thread& rank : ranks) rank.join();
  return results;
}

}  // namespace mesamis
