// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::restore {

/// An image without impulses.
struct WithoutImpulses {
  Volume volume;
  std::size_t replaced = 0;  ///< voxels
};

/// Replaces impulses (salt and pepper, dead detector elements) by the median of their neighbours.
///
/// A voxel is an impulse if fewer than two of its 26 neighbours are within `difference` of it: even
/// a line one voxel thin has two, except at its ends.
/// @param volume       as many samples as voxels; taken over, pass it with std::move() to save the
///                     copy.
/// @param difference   native units, > 0; well above the noise.
/// @param least_share  of the voxels, 0 to 1: where fewer are found, all stay as they are.
///
/// The same bits for any number of threads.
WithoutImpulses remove_impulses(Volume volume, double difference, double least_share = 0);

}  // namespace mesamis::detail::restore
