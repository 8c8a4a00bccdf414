// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "chosen_scan.h"

namespace mesamis {

/// Tells what a run of `segment` needs before it starts, from the headers of what it reads.
///
/// Entries: "program"; "input" with "path" (null: labels alone), "size" and "spacing_mm"; "voxels";
/// "memory_bytes", the sum of "memory" with "samples", "labels" and "method". The method's share is
/// memory_needed(); with labels that of the flow of all voxels is beside it, as if the objects
/// filled the scan. Elements of a body are not counted.
/// @param mesh  whether a mesh is asked for: labels alone need none.
/// @throws InputError  as read_grid(), read_request() and cropped_size().
nlohmann::ordered_json run_plan(const ScanArguments& arguments, const Settings& settings,
                                bool mesh);

}  // namespace mesamis
