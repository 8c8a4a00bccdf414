// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/nearby_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::restore {
namespace {

constexpr NearbyRange::Range kNothing{std::numeric_limits<float>::infinity(),
                                      -std::numeric_limits<float>::infinity()};

NearbyRange::Range hull(const NearbyRange::Range& a, const NearbyRange::Range& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

}  // namespace

NearbyRange::NearbyRange(const std::array<Index, 3>& size, std::span<const float> values,
                         const std::array<double, 3>& reach) {
  for (std::size_t a = 0; a < 3; ++a) count_[a] = (size[a] + kSide - 1) / kSide;
  find_ranges(size, values);
  for (std::size_t a = 0; a < 3; ++a) {
    const double blocks = std::ceil(reach[a] / kSide);
    widen(a, static_cast<Index>(std::min<double>(blocks, count_[a])));
  }
}

void NearbyRange::find_ranges(const std::array<Index, 3>& size, std::span<const float> values) {
  blocks_.assign(place(0, 0, count_[2]), kNothing);
  parallel_for_each(static_cast<std::size_t>(count_[2]), [&](std::size_t layer) {
    const auto first = static_cast<Index>(layer) * kSide;
    for (Index k = first; k < std::min(first + kSide, size[2]); ++k) {
      for (Index j = 0; j < size[1]; ++j) {
        const auto row = (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
                          static_cast<std::size_t>(j)) *
                         static_cast<std::size_t>(size[0]);
        for (Index i = 0; i < size[0]; ++i) {
          Range& block = blocks_[place(i / kSide, j / kSide, static_cast<Index>(layer))];
          const float value = values[row + static_cast<std::size_t>(i)];
          block = hull(block, {value, value});
        }
      }
    }
  });
}

void NearbyRange::widen(std::size_t axis, Index blocks) {
  const std::vector<Range> before = blocks_;
  const std::array<std::size_t, 3> steps{1, place(0, 1, 0), place(0, 0, 1)};
  parallel_for(blocks_.size(), [&](std::size_t n) {
    const auto at = static_cast<Index>(n / steps[axis] % static_cast<std::size_t>(count_[axis]));
    const Index first = std::max(0, at - blocks), last = std::min(count_[axis] - 1, at + blocks);
    const std::size_t line = n - static_cast<std::size_t>(at) * steps[axis];
    Range range = kNothing;
    for (Index b = first; b <= last; ++b) {
      range = hull(range, before[line + static_cast<std::size_t>(b) * steps[axis]]);
    }
    blocks_[n] = range;
  });
}

}  // namespace mesamis::detail::restore
