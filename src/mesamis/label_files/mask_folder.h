// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "mesamis/files/memory_budget.h"
#include "mesamis/label_files/read_labels.h"

/// Folders that hold one object per file, as TotalSegmentator writes them.
namespace mesamis::detail::label_files {

/// The name of a file without its extensions: "hip_left" of "hip_left.nii.gz", and of
/// "hip_left.seg.nrrd".
std::string object_name(const std::filesystem::path& file);

/// @throws InputError  naming the file, if its grid has another size than that of the first file,
///                     or lies more than 1e-3 of a voxel beside it.
void require_same_grid(const std::filesystem::path& file, const VoxelGrid& found,
                       const std::filesystem::path& first, const VoxelGrid& expected);

/// The files of a folder that may be masks, in the order of their names: volumes in files of arrays
/// and TIFF files of several pages, but those whose names begin with a dot.
/// @throws InputError  as files_in().
std::vector<std::filesystem::path> masks_in(const std::filesystem::path& folder,
                                            MemoryBudget& budget);

/// How the files of a folder are read.
struct MaskReader {
  std::function<LabelFile(const std::filesystem::path&)> read;
  /// The grid that its header states; none where it states no place.
  std::function<std::optional<VoxelGrid>(const std::filesystem::path&)> grid;
};

/// Reads masks as the objects of one label map, numbered from 1 and named after their files. The
/// only file may be a label map of many objects. Masks that overlap lie in different layers, with a
/// warning. Empty ones are objects without a voxel, with a warning. Masks that were cut out of one
/// grid, or whose axes run elsewhere, are put together on a grid that holds all of them.
/// @param files  at least one.
/// @throws InputError  naming the file whose voxels lie between those of the first, several layers
///                     or several objects, and what the reader throws.
///
/// O(voxels * files). Memory: the layers, and one file at a time.
LabelFile read_masks(const std::vector<std::filesystem::path>& files, const MaskReader& reader,
                     MemoryBudget& budget);

}  // namespace mesamis::detail::label_files
