// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/files/memory_budget.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/read_volume.h"

/// Pictures of a directory as the slices of one volume.
namespace mesamis::detail::volume_files {

/// Compares names as people count: a run of digits counts as a number, so that "s9" comes before
/// "s10". Names that differ only in zeros before a number are ordered by their characters.
bool natural_less(const std::string& a, const std::string& b);

/// The pictures that are the slices of a directory, in natural order of their names: its .tif,
/// .tiff, .png, .bmp, .jpg and .jpeg files without those whose names begin with a dot and SkyScan's
/// scout view, if there are two at least and the first holds one slice. Else none.
/// @throws InputError  as files_in().
std::vector<std::filesystem::path> slices_in(const std::filesystem::path& directory,
                                             MemoryBudget& budget);

/// Whether a directory, or one below it, holds a file that looks like DICOM.
/// @throws InputError  as files_below().
bool holds_dicom(const std::filesystem::path& directory);

/// The same as slices_in(), but none where the directory, or one below it, holds DICOM: pictures
/// beside a series are previews.
/// @throws InputError  as files_below().
std::vector<std::filesystem::path> slices_without_dicom(const std::filesystem::path& directory,
                                                        MemoryBudget& budget);

/// Reads pictures of one slice each, only those that are asked for.
/// @param files   in the order of the slices.
/// @param choice  which of several channels.
SliceReader read_pictures(std::vector<std::filesystem::path> files, const ValueChoice& choice);

/// The headers of all files, held against each other, as one volume. Its reader opens only the
/// files of the slices that are asked for.
/// @param files  at least one.
/// @throws InputError  as read_slices().
///
/// O(bytes) of the headers, for PNG and BMP of whole files.
OpenSlices open_stack(const std::filesystem::path& directory,
                      const std::vector<std::filesystem::path>& files, const Opening& opening);

/// Reads the pictures as slices, the first at z = 0. Spacing as SkyScan's log beside them has it;
/// else along x and y as the first file has it, 1 mm between slices with a warning. Numbers in the
/// names that do not go up in equal steps are a warning: a slice may be missing.
/// @param files    at least one.
/// @param options  to announce() the grid to.
/// @throws InputError  naming the file, if a picture is of another format, size, type or (where
///                     none is given) spacing than the first, or holds more than one slice.
///
/// Memory: 4 bytes per pixel, and one file at a time.
VolumeFile read_slices(const std::filesystem::path& directory,
                       const std::vector<std::filesystem::path>& files, const ReadOptions& options,
                       MemoryBudget& budget);

/// The same without the samples; what read_slices() would refuse for is the problem.
VolumeInfo describe_slices(const std::filesystem::path& directory,
                           const std::vector<std::filesystem::path>& files, const Opening& opening);

}  // namespace mesamis::detail::volume_files
