// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/files/memory_budget.h"
#include "mesamis/files/value_axes.h"

/// What the description of a TIFF says of its pages: ImageJ's, OME-XML, and tifffile's.
namespace mesamis::detail::volume_files {

/// How the pages of a file are slices, volumes and channels, and what their values and pixels are.
struct TiffLayout {
  ValueAxes axes;
  std::int64_t slices = 0;           ///< of each channel of each volume
  std::vector<std::int64_t> planes;  ///< (channel * volumes + volume) * slices + slice to the
                                     ///< number of a page; -1: not in this file
  Vec3 spacing{};                    ///< mm along x, y, z; 0 where it is not stated
  std::string unit;                  ///< of the resolution; empty: that of the tag
  bool unit_of_tag_alone = false;    ///< without a tag there is no unit; else it is inch then
  std::string unit_y, unit_z;        ///< along y and of `between`; empty: that along x
  double between = 0;                ///< of slices, in its unit; 0: not stated
  Vec3 zero_pixel{};                 ///< the pixel at the world's origin, pixels
  double slope = 1, intercept = 0;   ///< native value = slope * stored + intercept
  bool one_directory = false;        ///< whether all planes may lie behind one directory
  bool with_thumbnails = false;      ///< whether the numbers of pages count thumbnails
  std::vector<std::string> warnings{};
};

/// Reads a description. A text of another kind tells nothing: all pages are slices.
/// @param file   for messages.
/// @param text   ImageDescription of the first page.
/// @param pages  in the file, without thumbnails.
/// @param most   planes that the file can hold.
/// @throws InputError  for a layout that contradicts itself or the number of pages; as parse_xml().
///
/// O(text + planes).
TiffLayout read_tiff_layout(const std::filesystem::path& file, std::string_view text,
                            std::int64_t pages, std::int64_t most, MemoryBudget& budget);

}  // namespace mesamis::detail::volume_files
