// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/label_map.h"

namespace mesamis {

/// Prints one line per segment: its label, name, voxels and volume in mm^3.
void print_labels(const LabelMap& map);

}  // namespace mesamis
