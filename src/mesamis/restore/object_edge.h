// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "mesamis/image/grey_values.h"
#include "mesamis/image/volume.h"
#include "mesamis/restore/half_maximum_level.h"

namespace mesamis::detail::restore {

/// Chooses the window in which an object's edge is measured: the default one, widened where the
/// level has no room for half the contrast on both its sides. What lies beyond it (air, metal) must
/// not ring when the blur is undone, nor count as noise.
/// @param volume    at least one sample, all finite.
/// @param contrast  of the object, native units.
/// @param level     native units.
/// @return native units; low at most high.
Window window_with_room(const VolumeView& volume, const ObjectContrast& contrast, double level);

/// Measures an object's level and contrast where it is thick.
///
/// Medians over the whole surface (find_half_maximum_level()) mix thick parts with walls so thin
/// that the blur keeps them from their own value: the level then depends on how much of the surface
/// is thin, and on the crop. Here the edge is fitted (measure_edge()) at the thickest quarter of
/// the surface (thick_places()), and once more at the level found, until the level changes by less
/// than 0.005 of the contrast. Where the way through the object was seen to end, the shell of the
/// fit may be as thick as the thinnest of these places and 0.75 voxels more, and 2.5 voxels
/// elsewhere.
///
/// Where the object is not of one material (measure_variation() of more than 0.06 of the contrast),
/// thin parts have another value than thick ones, and the blur hides which. Between variations of
/// 0.06 and 0.12 level and contrast move linearly from those at thick places to the mean of these
/// and of those seen. Where fewer than a hundred places can be judged, they stay as they are: thin
/// walls seem to vary through the blur.
/// @param volume  native values, as they came: a restored image overshoots.
/// @param seen    of this volume: where to start.
/// @return level and contrast are the edge's (background and shell), or mixed with those seen; all
///         as seen where no edge can be fitted.
///
/// O(voxels) per iteration, at most three; a smoothed copy of the samples.
HalfMaximumLevel find_object_edge(const VolumeView& volume, const HalfMaximumLevel& seen);

/// The object of a scan, and the window in which its edge is measured.
struct SeenObject {
  HalfMaximumLevel seen;    ///< through all of its surface
  HalfMaximumLevel object;  ///< where it is thick; as seen where there is no contrast
  Window window;            ///< see window_with_room()
};

/// What is known of an object before it is looked for.
struct SeeOptions {
  std::optional<double> start{};  ///< see HalfMaximumOptions
  std::optional<double>
      level{};  ///< native units, for which the window has room; default: that seen
};

/// Finds the object of a scan and measures its edge: find_half_maximum_level(), and
/// find_object_edge() in the window with room.
/// @param volume  native values; usable, see require_usable().
///
/// O(voxels) per iteration of both; two copies of the samples.
SeenObject see_object(const VolumeView& volume, const SeeOptions& options = {});

}  // namespace mesamis::detail::restore
