// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/method/label_run.h"

namespace mesamis::detail::method {

/// The volume that parts and cavities of a labelled object have at least: that of a voxel of the
/// labels, unless the settings say otherwise.
/// @return mm^3, >= 0.
double least_volume(const LabelRun& run);

/// Decimates the boundaries of all layers by one tolerance, and makes a surface of each object with
/// the parts that the settings leave. A preview is rounded in any case.
/// @param layers  as they were placed; world frame, mm.
/// @param input   of the image, which tells the error to expect; nullptr: the labels are right.
/// @param result  with the parameters of the run; gets the tolerance, objects, boundaries and the
///                time that this takes.
/// @throws Cancelled  if progress says stop.
///
/// Cost as simplify_partition(). The same bits for any number of threads.
void finish_layers(const LabelRun& run, std::vector<LayerBoundaries> layers, const RunInput* input,
                   LabelResult& result);

}  // namespace mesamis::detail::method
