// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/rooms.h"

namespace mesamis::detail::slabs {

/// What tasks on slabs have done: to see whether slabs have equal work, and what they cost beside
/// it.
struct SlabWork {
  std::int64_t voxels = 0;  ///< read and restored
  std::int64_t rows = 0;    ///< of linear systems: nodes of grids and meshes
  std::int64_t cells = 0;   ///< that the remesher made
  std::int64_t bytes = 0;   ///< read of what belongs to other slabs
  double seconds = 0;       ///< wall time

  /// Adds the work of other tasks.
  SlabWork& operator+=(const SlabWork& other) noexcept {
    voxels += other.voxels;
    rows += other.rows;
    cells += other.cells;
    bytes += other.bytes;
    seconds += other.seconds;
    return *this;
  }
};

}  // namespace mesamis::detail::slabs
