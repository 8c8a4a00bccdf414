// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/files/memory_budget.h"
#include "mesamis/image/label_map.h"

/// Names and colours of labels in the header extensions of NIfTI files, and such files written.
namespace mesamis::detail::label_files {

/// The labels of the first extension that holds XML with the root CaretExtension; none if there is
/// none. The label 0, labels without a name and those that come again are left out.
/// @param file  for messages.
/// @throws InputError  for broken XML and labels out of range.
///
/// O(bytes), up to a logarithm.
std::vector<Segment> segments_in_extensions(const std::filesystem::path& file,
                                            const std::vector<std::string>& extensions,
                                            MemoryBudget& budget);

/// The XML of such an extension.
std::string caret_extension(std::span<const Segment> segments);

/// A NIfTI-1 file up to its samples, with an extension: sform and qform in RAS, mm, codes 1.
/// @param sample_bytes  1 or 2: unsigned samples of 8 or 16 bits, little endian.
/// @param extension     an even number of characters is not needed: it is padded.
std::string nifti_header(const VoxelGrid& grid, std::size_t sample_bytes,
                         std::string_view extension);

}  // namespace mesamis::detail::label_files
