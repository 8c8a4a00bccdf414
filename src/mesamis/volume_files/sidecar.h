// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/files/memory_budget.h"

/// The JSON file beside an image, as the Brain Imaging Data Structure and dcm2niix have it.
namespace mesamis::detail::volume_files {

/// Reads the modality that a sidecar states: "a.json" beside "a.nii.gz", field "Modality".
/// @param image     the image's path.
/// @param warnings  one is added for a sidecar that cannot be read: it does not count then.
/// @return "CT", "MR" and so on; empty where nothing states it.
/// @throws InputError  as MemoryBudget::claim().
///
/// O(bytes of the sidecar).
std::string modality_in_sidecar(const std::filesystem::path& image, MemoryBudget& budget,
                                std::vector<std::string>& warnings);

}  // namespace mesamis::detail::volume_files
