// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/close_tunnels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/image/gaussian.h"
#include "mesamis/surface/neighbours.h"

namespace mesamis::detail::fit {
namespace {

constexpr float kFaintest = -0.6F, kRaised = 0.5F;
constexpr Index kThinReach = 3;  // voxels along each axis to what is darker than faint
constexpr double kThinShare = 0.8;
constexpr std::size_t kLargePart = 50;  // voxels
constexpr std::size_t kSmallSheet = 8;  // voxels
/// Voxels, of the fall-off of the lift; and its weight far away.
constexpr double kSpread = 0.7, kPull = 0.1;

enum class State : std::uint8_t { kBackground, kFaint, kObject };

/// Voxels of one sheet, by increasing number.
using Sheet = std::vector<Index>;

/// The object in an image, and the sheets that close its tunnels.
class TunnelFinder {
 public:
  explicit TunnelFinder(const VolumeView& height)
      : height_(height), states_(height.samples.size(), State::kBackground) {
    parallel_for(states_.size(), [&](std::size_t n) {
      const float h = height.samples[n];
      states_[n] = h >= 0 ? State::kObject : h >= kFaintest ? State::kFaint : State::kBackground;
    });
  }

  std::vector<Sheet> closing_sheets() {
    thin(false);
    thin(true);
    number_parts();
    std::vector<Sheet> closing;
    std::vector<bool> seen(states_.size());
    for (std::size_t n = 0; n < states_.size(); ++n) {
      if (states_[n] != State::kFaint || seen[n]) continue;
      Sheet sheet = sheet_at(static_cast<Index>(n), seen);
      if (is_wall(sheet) && closes_tunnels(sheet)) closing.push_back(std::move(sheet));
    }
    return closing;
  }

 private:
  State& state(Index voxel) { return states_[static_cast<std::size_t>(voxel)]; }
  State state(Index voxel) const { return states_[static_cast<std::size_t>(voxel)]; }

  /// The neighbours of a voxel that are in that state or brighter.
  unsigned set_around(Index voxel, State least) const {
    return Neighbours(height_.size, voxel).set_of([&](Index other) {
      return state(other) >= least;
    });
  }

  template <class Visit>
  void for_each_neighbour(Index voxel, Visit&& visit) const {
    const Neighbours around(height_.size, voxel);
    for (std::size_t i = 0; i < 14; ++i) {
      if (around[i] != kNoIndex) visit(around[i]);
    }
  }

  /// Takes faint voxels off, the darkest first, where the topology stays.
  /// @param cut_bridges  also where parts come apart.
  void thin(bool cut_bridges) {
    using Entry = std::pair<float, Index>;
    std::vector<Entry> all;
    std::vector<bool> waits(states_.size());
    for (std::size_t n = 0; n < states_.size(); ++n) {
      if (states_[n] != State::kFaint) continue;
      all.emplace_back(height_.samples[n], static_cast<Index>(n));
      waits[n] = true;
    }
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>{},
                                                                         std::move(all));
    while (!queue.empty()) {
      const Index voxel = queue.top().second;
      queue.pop();
      waits[static_cast<std::size_t>(voxel)] = false;
      const unsigned set = set_around(voxel, State::kFaint);
      if (count_parts(kAllNeighbours & ~set) != 1) continue;
      const Index parts = count_parts(set);
      if (parts == 0 || (parts > 1 && !cut_bridges)) continue;
      state(voxel) = State::kBackground;
      for_each_neighbour(voxel, [&](Index other) {
        const auto n = static_cast<std::size_t>(other);
        if (states_[n] != State::kFaint || waits[n]) return;
        waits[n] = true;
        queue.emplace(height_.samples[n], other);
      });
    }
  }

  /// Visits what is connected with a voxel and in its state, it included, in a fixed order.
  /// @param is_new  whether a voxel was not visited before; marks it.
  template <class IsNew>
  std::vector<Index> connected(Index from, const IsNew& is_new) const {
    std::vector<Index> found;
    if (is_new(from)) found.push_back(from);
    for (std::size_t next = 0; next < found.size(); ++next) {
      for_each_neighbour(found[next], [&](Index other) {
        if (state(other) == state(from) && is_new(other)) found.push_back(other);
      });
    }
    return found;
  }

  void number_parts() {
    parts_.assign(states_.size(), kNoIndex);
    for (std::size_t n = 0; n < states_.size(); ++n) {
      if (states_[n] != State::kObject || parts_[n] != kNoIndex) continue;
      const auto part = static_cast<Index>(part_sizes_.size());
      const auto found = connected(static_cast<Index>(n), [&](Index voxel) {
        return std::exchange(parts_[static_cast<std::size_t>(voxel)], part) == kNoIndex;
      });
      part_sizes_.push_back(found.size());
    }
  }

  Sheet sheet_at(Index voxel, std::vector<bool>& seen) const {
    Sheet sheet = connected(voxel, [&](Index other) {
      const auto n = static_cast<std::size_t>(other);
      if (seen[n]) return false;
      seen[n] = true;
      return true;
    });
    std::sort(sheet.begin(), sheet.end());
    return sheet;
  }

  /// Whether something darker than faint is near.
  bool is_thin_at(Index voxel) const {
    const auto at = grid_place(height_.size, voxel);
    std::array<Index, 3> low{}, high{};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::max(at[a] - kThinReach, 0);
      high[a] = std::min(at[a] + kThinReach, height_.size[a] - 1);
    }
    for (Index k = low[2]; k <= high[2]; ++k) {
      for (Index j = low[1]; j <= high[1]; ++j) {
        const auto row =
            height_.samples.begin() + static_cast<std::ptrdiff_t>(height_.offset(0, j, k));
        const auto is_dark = [](float height) { return height < kFaintest; };
        if (std::any_of(row + low[0], row + high[0] + 1, is_dark)) return true;
      }
    }
    return false;
  }

  /// Whether a sheet is thin, lies in one large part at most, and fills no slit.
  bool is_wall(const Sheet& sheet) const {
    std::vector<Index> large;
    std::size_t thin = 0, beside = 0;
    for (const Index voxel : sheet) {
      bool touches = false;
      for_each_neighbour(voxel, [&](Index other) {
        const Index part = parts_[static_cast<std::size_t>(other)];
        if (part == kNoIndex) return;
        touches = true;
        if (part_sizes_[static_cast<std::size_t>(part)] > kLargePart) large.push_back(part);
      });
      beside += touches ? 1U : 0U;
      thin += is_thin_at(voxel) ? 1U : 0U;
    }
    const bool joins_parts =
        std::adjacent_find(large.begin(), large.end(), std::not_equal_to<>()) != large.end();
    const bool fills_slit = sheet.size() > kSmallSheet && beside == sheet.size();
    return beside > 0 && !joins_parts && !fills_slit &&
           static_cast<double>(thin) >= kThinShare * static_cast<double>(sheet.size());
  }

  /// Adds a sheet to the object, if that raises its Euler characteristic.
  bool closes_tunnels(const Sheet& sheet) {
    for (const Index voxel : sheet) state(voxel) = State::kBackground;
    Index change = 0;
    for (const Index voxel : sheet) {
      change += euler_change(set_around(voxel, State::kObject));
      state(voxel) = State::kObject;
    }
    if (change > 0) return true;
    for (const Index voxel : sheet) state(voxel) = State::kBackground;
    return false;
  }

  const VolumeView height_;
  std::vector<State> states_;  // as thinned
  std::vector<Index> parts_;   // of the object's voxels as they were, else kNoIndex
  std::vector<std::size_t> part_sizes_;
};

}  // namespace

TunnelLift find_tunnel_lift(Volume height) {
  TunnelLift found;
  if (height.voxel_count() > static_cast<std::size_t>(std::numeric_limits<Index>::max())) return {};
  const std::vector<Sheet> sheets = TunnelFinder(height).closing_sheets();
  if (sheets.empty()) return {};
  Volume weights{height, std::vector<float>(height.samples.size(), 0)}, rises = weights;
  found.sheets = std::ssize(sheets);
  for (const Sheet& sheet : sheets) {
    found.voxels += std::ssize(sheet);
    for (const Index voxel : sheet) {
      const auto n = static_cast<std::size_t>(voxel);
      weights.samples[n] = 1;
      rises.samples[n] = kRaised - height.samples[n];
    }
  }
  const WeightedMeans means(std::move(rises), std::move(weights), kSpread, kPull);
  found.lift = std::move(height);
  parallel_for(found.lift.samples.size(),
               [&](std::size_t n) { found.lift.samples[n] = static_cast<float>(means.at(n)); });
  return found;
}

}  // namespace mesamis::detail::fit
