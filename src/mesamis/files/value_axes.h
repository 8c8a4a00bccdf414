// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// Files with more than one value per voxel: which one a reader takes.
namespace mesamis::detail::files {

/// What a file has beside the axes of space.
struct ValueAxes {
  std::int64_t volumes = 1;   ///< of a series: times, phases
  std::int64_t channels = 1;  ///< of each volume: colours, stains, components
};

/// What the user asks for, both from 0.
struct ValueChoice {
  std::optional<Index> volume{}, channel{};
};

/// The value of each voxel that is taken, both from 0.
struct TakenValue {
  std::int64_t volume = 0, channel = 0;
};

/// Chooses one value per voxel. Where a file has only one of both axes, either number means it.
/// @param file  begins the message.
/// @throws InputError  if there is a choice and none was made, or it does not exist; the message
///                     lists what there is.
///
/// O(1).
TakenValue take_value(const std::filesystem::path& file, const ValueAxes& axes,
                      const ValueChoice& choice);

}  // namespace mesamis::detail::files
