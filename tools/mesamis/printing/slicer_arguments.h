// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mesamis/printing/slice_settings.h"
#include "mesamis/printing/slicer.h"

namespace mesamis::detail::printing {

/// The files that a slicer reads and writes, in the folder where it runs.
inline constexpr const char* kSurfaceFile = "surface.stl";
inline constexpr const char* kGcodeFile = "print.gcode";

/// The command line, without the program, that slices kSurfaceFile into kGcodeFile.
///
/// The surface is taken to stand on the bed, see place_on_bed(): it is neither moved nor scaled.
/// All that the settings do not name is the slicer's own default, not the user's configuration.
/// @param settings  see require_valid().
std::vector<std::string> slicer_arguments(const InstalledSlicer& slicer,
                                          const SliceSettings& settings);

}  // namespace mesamis::detail::printing
