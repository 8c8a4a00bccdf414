// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::restore {

/// Bounds of values on a regular grid around each of its voxels: they tell where nothing is to be
/// found, so that nothing need be looked for.
class NearbyRange {
 public:
  struct Range {
    float low, high;  ///< in the unit of the values
  };

  /// Finds the bounds.
  /// @param size    voxels along each axis, at least 1.
  /// @param values  one per voxel, finite, any unit; i runs fastest, then j, k.
  /// @param reach   voxels along each axis, >= 0.
  ///
  /// O(voxels), in threads; an eighth of a byte per voxel is kept.
  NearbyRange(const std::array<Index, 3>& size, std::span<const float> values,
              const std::array<double, 3>& reach);

  /// Bounds of the values of all voxels within the reach of a voxel along each axis, and of some
  /// that are up to eight voxels further.
  /// @param i, j, k  within the grid.
  const Range& at(Index i, Index j, Index k) const noexcept {
    return blocks_[place(i / kSide, j / kSide, k / kSide)];
  }

 private:
  static constexpr Index kSide = 4;  // voxels of a block

  std::size_t place(Index i, Index j, Index k) const noexcept {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(count_[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(i);
  }
  void find_ranges(const std::array<Index, 3>& size, std::span<const float> values);
  void widen(std::size_t axis, Index blocks);

  std::array<Index, 3> count_{};  // blocks along each axis
  std::vector<Range> blocks_;
};

}  // namespace mesamis::detail::restore
