// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// How 3D Slicer learns what `slicer-segment` takes: the module description of its execution model,
/// docs/slicer.md.
namespace mesamis {

/// The value of --tissue that stands for all that is bright, which has no name of its own.
inline constexpr const char* kAnyBright = "bright";

/// The value of --modality that leaves it to the file and its values.
inline constexpr const char* kStatedModality = "auto";

/// That and the modalities.
std::vector<std::string> modality_words();

/// The results that the module gives back in its file of return parameters, in this order. Slicer
/// keeps values and results under one set of names: none of these is that of a setting.
inline constexpr const char* kSlicerResults[] = {
    "result_objects", "result_triangles", "result_volume_cm3", "result_area_cm2",
    "result_level",   "result_error_mm",  "result_outcome"};

/// The module description as XML: the settings are those of setting_table(), with their groups,
/// ranges, defaults and help.
std::string slicer_description();

}  // namespace mesamis
