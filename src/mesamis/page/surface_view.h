// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesamis/page/slice_view.h"
#include "mesamis/picture/raster.h"

namespace mesamis::detail::page {

/// The names of the views: front, left, top, oblique; anatomical in LPS.
std::vector<std::string> surface_views();

/// Draws surfaces in parallel projection, shaded, on white. No display and no graphics library is
/// needed; the same surfaces give the same bytes.
/// @param surfaces  at least one point.
/// @param view      one of surface_views(); another one counts as oblique.
/// @param pixels    along the longer side, at least 16.
///
/// O(points + triangles + pixels covered). Memory: 8 bytes and 12 per pixel.
Raster surface_view(std::span<const ShownSurface> surfaces, const std::string& view, int pixels);

}  // namespace mesamis::detail::page
