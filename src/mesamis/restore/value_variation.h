// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/restore/level_crossings.h"

namespace mesamis::detail::restore {

/// Measures how much an object's own value varies from place to place along its surface: teeth are
/// denser than the bone around them, cast plastic is everywhere the same.
///
/// The value of a place is the greatest within two and a half voxels below the surface, whatever
/// lies beneath (a lighter core). The variation is their standard deviation (from quartiles)
/// without what noise adds.
/// @param volume  native values.
/// @param points  thick_places() of the surface: the blur makes thin walls vary by themselves.
/// @param noise   of the volume, standard deviation, native units.
/// @return native units, >= 0; 0 if there are fewer than a hundred points with a normal.
double measure_variation(const VolumeView& volume, const std::vector<SurfacePoint>& points,
                         double noise);

}  // namespace mesamis::detail::restore
