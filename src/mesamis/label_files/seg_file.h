// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/label_files/seg_grid.h"

namespace mesamis::detail::label_files {

/// What the frames of a DICOM segmentation hold.
enum class SegType {
  kBinary,      ///< a bit per pixel, one segment per frame
  kFractional,  ///< shares of a maximum, one segment per frame
  kLabels,      ///< segment numbers
};

/// A DICOM segmentation that was read and checked, without its frames.
struct SegFile {
  DicomFile file;
  DicomPixels pixels;
  SegType type = SegType::kBinary;
  double most = 1;  ///< the largest value of a pixel of kFractional
  SegGrid grid;
  std::vector<Segment> segments;  ///< by ascending number, which is the label; all of layer 0
  std::vector<Index> number;      ///< of each frame, a label of the segments; empty for kLabels
};

/// Whether a file is of one of the SOP classes Segmentation Storage and Label Map Segmentation
/// Storage.
bool is_seg(const DicomFile& file);

/// Opens a file of the SOP classes Segmentation Storage and Label Map Segmentation Storage.
///
/// @throws InputError  for another file or a broken one, frames without a place or with a segment
///                     that is not described, two frames of one segment at one place, segment
///                     numbers out of range or twice, and as grid_of_frames().
///
/// O(bytes + frames), up to a logarithm.
SegFile open_seg(const std::filesystem::path& path, MemoryBudget& budget);

/// Reads one frame, from 0: the pixels row by row.
/// @param out  what it held is replaced.
/// @throws InputError  if the frame cannot be decoded.
void read_frame(const SegFile& seg, std::size_t frame, std::vector<float>& out,
                MemoryBudget& budget);

}  // namespace mesamis::detail::label_files
