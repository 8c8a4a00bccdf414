// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/restore/object_contrast.h"

namespace mesamis::detail::restore {

/// The level of half maximum: midway between the background and the object, both measured at the
/// object's surface. There a symmetric blur leaves a flat surface where it is.
struct HalfMaximumLevel {
  double level = 0;         ///< native units
  ObjectContrast contrast;  ///< at the surface of that level
  /// How surely it is known, native units: half of the way from the level of thick places to that
  /// of the whole surface. 0: not known.
  double uncertainty = 0;
  bool in_noise = false;  ///< nothing was found that stands out from the noise
};

struct HalfMaximumOptions {
  /// Level from which the iteration starts, native units; default: see find_half_maximum_level().
  std::optional<double> start = std::nullopt;
};

/// Finds the bright object of an image and its level of half maximum.
///
/// A fixed-point iteration: measure the contrast at the surface of the present level
/// (measure_contrast()), move the level to the half maximum, until it changes by less than 0.005 of
/// the contrast. It starts from 200 HU (bone) in CT; in other images from Otsu's threshold of all
/// voxels. If the contrast found so is less than 2.5 deviations of the noise, it starts again from
/// Otsu's threshold of the voxels on edges. If that finds less than 1.45 deviations (noise alone
/// makes 1.0 to 1.4), or less than 0.002 of the voxels on one side of the level, it starts from the
/// value that 2 % of the smoothed image exceed: thin objects are a small part of it. If that finds
/// no more, there is nothing but noise; an object smaller than 0.002 of a noisy image counts as
/// such.
/// @param volume  native values; usable, see require_usable().
/// @return a contrast of zero if the level has no surface to measure at; the level is then the one
///         the iteration started from.
///
/// O(voxels) per iteration, at most ten; a smoothed copy of the samples.
HalfMaximumLevel find_half_maximum_level(const VolumeView& volume,
                                         const HalfMaximumOptions& options = {});

}  // namespace mesamis::detail::restore
