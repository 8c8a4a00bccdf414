// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/restore/object_contrast.h"

namespace mesamis::detail::restore {

/// Chooses the threshold T of (13) for images of three classes (air, soft tissue, bone).
///
/// T is the upper end of the tissue outside the object: where the histogram, right of that tissue's
/// peak, has fallen to a tenth of it. It is no more than half way from the background up to the
/// level, so that no edge profile is cut in its middle, and at least 2.5 times the noise below the
/// level. Images of two classes need no threshold: those where Otsu's two classes of the samples
/// below the level are less than half the object's contrast apart, or less than four times the
/// noise (the two halves of one class of noise are 1.6 times the noise apart).
/// @param volume           native values, finite.
/// @param contrast, level  of the object, native units, see HalfMaximumLevel.
/// @param noise            standard deviation, native units.
/// @return native units; nothing if no threshold is needed.
std::optional<double> find_tissue_threshold(const VolumeView& volume,
                                            const ObjectContrast& contrast, double level,
                                            double noise);

}  // namespace mesamis::detail::restore
