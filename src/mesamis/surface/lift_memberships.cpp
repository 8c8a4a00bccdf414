// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/lift_memberships.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/match_volumes.h"
#include "mesamis/surface/neighbours.h"

namespace mesamis::detail::surface {
namespace {

/// By how much the own material wins where it is one node thick: as far as the boundary of such a
/// sheet is from where it belongs then, about half a node.
constexpr float kThinLead = 0.4F;
/// So often what nodes ask for is averaged with their neighbours.
constexpr Index kRounds = kLiftReach;

class Lift {
 public:
  explicit Lift(GridMemberships& grid) : grid_(grid), asked_(grid.material.size(), 0) {}

  void run() {
    for_listed([this](std::size_t n) { asked_[n] = asked_by(n); });
    for (Index round = 0; round < kRounds; ++round) {
      std::vector<float> next(asked_.size(), 0);
      for_listed([&](std::size_t n) { next[n] = mean(n); });
      asked_ = std::move(next);
    }
    for_listed([this](std::size_t n) {
      grid_.value[static_cast<std::size_t>(grid_.first[n])] += asked_[n];
    });
  }

 private:
  template <class Visit>
  void for_listed(Visit visit) const {
    parallel_for(asked_.size(), [&](std::size_t n) {
      if (grid_.first[n] < grid_.first[n + 1]) visit(n);
    });
  }

  float asked_by(std::size_t n) const {
    const auto begin = grid_.value.begin() + grid_.first[n];
    const float most = *std::max_element(begin + 1, grid_.value.begin() + grid_.first[n + 1]);
    const float lead = is_thin(n) ? kThinLead : kLeastLead;
    return std::max(0.0F, most + lead - *begin);
  }

  /// Whether other materials lie on both sides.
  bool is_thin(std::size_t n) const {
    const Neighbours around(grid_.size, static_cast<Index>(n));
    for (std::size_t i = 0; i < 7; ++i) {
      const Index below = around[i], above = around[i + 7];
      if (below == kNoIndex || above == kNoIndex) continue;
      if (grid_.material[below] != grid_.material[n] &&
          grid_.material[above] != grid_.material[n]) {
        return true;
      }
    }
    return false;
  }

  /// Of what a node and its neighbours of the same material ask for.
  float mean(std::size_t n) const {
    const Neighbours around(grid_.size, static_cast<Index>(n));
    float sum = asked_[n];
    int count = 1;
    for (std::size_t i = 0; i < 14; ++i) {
      const Index m = around[i];
      if (m == kNoIndex || grid_.material[m] != grid_.material[n]) continue;
      if (grid_.first[m] == grid_.first[m + 1]) continue;
      sum += asked_[m];
      ++count;
    }
    return sum / static_cast<float>(count);
  }

  GridMemberships& grid_;
  std::vector<float> asked_;
};

}  // namespace

void lift_memberships(GridMemberships& grid) { Lift(grid).run(); }

}  // namespace mesamis::detail::surface
