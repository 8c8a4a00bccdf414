// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/grey_values.h"
#include "mesamis/image/volume.h"

/// Dark objects (airways in CT, bone in MR): in the mirrored image they are bright.
namespace mesamis {

/// Turns the sign of all samples. A dark object becomes a bright one, with the same surface at the
/// mirrored level. Twice gives the volume back.
/// @param volume  native units; taken over, pass it with std::move() to save the copy.
/// @return native units, mirrored.
Volume mirrored(Volume volume);

/// The level, native units, that belongs to a mirrored one, and the other way round.
inline double mirrored(double level) noexcept { return -level; }

/// The window, native units, that belongs to a mirrored one, and the other way round: its ends
/// change places.
inline Window mirrored(const Window& window) noexcept { return {-window.high, -window.low}; }

/// Makes an image in which all that lies between two values is bright: that many native units above
/// 0 by which a sample is within the range, and below 0 those outside. Its level is 0.
///
/// Where an object that is brighter than the range borders on one that is darker, the blur passes
/// through the range: the image then shows a skin about a voxel thick.
/// @param volume  taken over.
/// @param range   native units, low < high.
/// @return native units.
/// @throws InputError  unless low < high.
Volume within_range(Volume volume, const Window& range);

}  // namespace mesamis
