// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/rooms.h"

namespace mesamis::detail::remesh {

/// How many operations were done.
struct Counters {
  std::int64_t splits = 0, collapses = 0, swaps = 0, moves = 0;
  Counters& operator+=(const Counters& other) {
    splits += other.splits;
    collapses += other.collapses;
    swaps += other.swaps;
    moves += other.moves;
    return *this;
  }
};

}  // namespace mesamis::detail::remesh
