// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/files/memory_budget.h"
#include "mesamis/label_files/read_labels.h"

namespace mesamis::detail::label_files {

/// read_label_map() of a DICOM segmentation.
///
/// Segments go to the first layer where they overlap no other, by ascending number.
/// @throws InputError  as open_seg(), for pixels that cannot be decoded or refer to no segment, and
///                     if overlapping segments need more layers than the file's size allows.
///
/// O(pixels * layers), plus the voxels of the layers.
LabelFile read_dicom_labels(const std::filesystem::path& path, MemoryBudget& budget);

/// read_probabilities() of one: layer n holds segment n, whose label is n + 1.
/// @throws InputError  as read_dicom_labels(), and for a segmentation of segment numbers.
///
/// O(pixels), plus the voxels of the layers.
ProbabilityFile read_dicom_probabilities(const std::filesystem::path& path, MemoryBudget& budget);

}  // namespace mesamis::detail::label_files
