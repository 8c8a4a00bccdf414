// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// Scans that are label maps by mistake.
namespace mesamis::detail::object {

/// The values of an image that looks like a label map.
struct FewValues {
  std::size_t count = 0;  ///< different values
  double least = 0, most = 0;
};

/// Finds out whether an image is likely a label map: all values are whole and none is negative, at
/// most 1000 of them differ, and of the neighbours along i that are not both the most frequent
/// value half are equal. A single value is none.
/// @param volume  finite samples.
/// @return the values; nothing for any other image.
/// @throws nothing
///
/// O(voxels), as a rule less: the first fraction ends the search.
std::optional<FewValues> find_few_whole_values(const VolumeView& volume);

}  // namespace mesamis::detail::object
