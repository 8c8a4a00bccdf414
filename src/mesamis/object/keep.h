// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::object {

/// What is left around a mask.
struct KeepOptions {
  double margin = 2;      ///< mm, >= 0: nothing changes within this distance of the mask
  double background = 0;  ///< native units: what brighter samples elsewhere fall to
};

/// Removes what is bright outside of a mask.
///
/// The samples within the margin are not touched: there the image alone places the object's
/// surface, also beside a mask that is too small by the margin. Beyond it, only samples above the
/// background change: s becomes background + w (s - background), where w falls from 1 at the margin
/// to 0 two voxels further out, smoothly (3 t^2 - 2 t^3). A brighter neighbour that reaches into
/// the margin is cut in these two voxels; an object that ends within the margin gets no new edge,
/// as nothing beyond is made brighter, and what is darker stays.
/// @param volume   native units; taken over, pass it with std::move() to save the copy.
/// @param mask     one mark per voxel, such as mask_on() makes; not empty.
/// @param options  see there.
/// @return native units.
/// @throws InputError  if the mask does not fit the volume or is empty, or an option is out of
///                     range.
///
/// O(voxels), in threads; 4 bytes per voxel. The same bits for any number of threads.
Volume kept_to(Volume volume, std::span<const std::uint8_t> mask, const KeepOptions& options);

/// Removes what is bright within a mask: the other way round. Only samples that are more than the
/// margin inside of the mask change.
/// @param volume   as for kept_to().
/// @param mask     one mark per voxel; may be empty, and then nothing changes.
/// @param options  a margin of 0 begins at the mask's border. To take a blurred edge away with its
///                 object, use dilated() on the mask before.
/// @return native units.
/// @throws InputError  as kept_to(), and if the mask holds all voxels.
///
/// O(voxels), as kept_to().
Volume without(Volume volume, std::span<const std::uint8_t> mask, const KeepOptions& options);

}  // namespace mesamis::detail::object
