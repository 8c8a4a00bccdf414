// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "mesamis/rooms.h"

namespace mesamis::detail::image {

/// What was NaN in a scan: voxels outside of what was measured.
struct NotNumbers {
  std::size_t voxels = 0;
  float filled = 0;  ///< what they are now, native units
};

/// Gives samples that are NaN the least value of the others, so that they count as background.
/// Where all are NaN, or none is, nothing changes.
/// @param samples  native units.
/// @return how many were changed, and to what.
/// @throws nothing
///
/// O(samples).
NotNumbers fill_not_numbers(std::span<float> samples) noexcept;

}  // namespace mesamis::detail::image
