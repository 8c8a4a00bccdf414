// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/rooms.h"

/// The names of the arrays of a .vtp.
namespace mesamis::detail::shape_files {

inline constexpr const char* kFrameField = "SPACE";
inline constexpr const char* kNameField = "Name";
inline constexpr const char* kLabelsField = "ObjectLabels";
inline constexpr const char* kNamesField = "ObjectNames";
inline constexpr const char* kLabelArray = "label";
inline constexpr const char* kColourArray = "RGB";

}  // namespace mesamis::detail::shape_files
