// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/rooms.h"

/// The fields of 3D Slicer's segmentations (.seg.nrrd) among the keys of a NRRD file.
namespace mesamis::detail::label_files {

/// The segments that the fields SegmentN_Name, _ID, _LabelValue, _Layer and _Color describe, in the
/// order of N; none if there are no such fields.
/// @param layers  of the file, at least 1. Files of one layer per segment state neither.
/// @throws InputError  for labels out of range, layers that are not there, and two segments of one
///                     layer and label.
///
/// O(keys), up to a logarithm.
std::vector<Segment> segments_in_keys(const std::filesystem::path& file,
                                      const std::map<std::string, std::string>& keys,
                                      std::size_t layers);

/// The keys for the segments of a map, with what Slicer needs beside them.
///
/// O(voxels * layers + segments).
std::vector<std::pair<std::string, std::string>> segment_keys(const LabelMap& map);

}  // namespace mesamis::detail::label_files
