// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/write_labels.h"

#include <algorithm>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/deflate.h"
#include "mesamis/files/refuse.h"
#include "mesamis/label_files/nifti_labels.h"
#include "mesamis/label_files/nrrd_segments.h"
#include "mesamis/volume_files/nrrd_header.h"

namespace mesamis::detail::label_files {
namespace {

namespace fs = std::filesystem;

/// 1 if all labels fit into 8 bits, else 2.
std::size_t bytes_per_label(const LabelMap& map) {
  for (const auto& layer : map.layers) {
    const auto large = [](std::uint16_t label) { return label > 255; };
    if (std::any_of(layer.begin(), layer.end(), large)) return 2;
  }
  return 1;
}

/// Little endian, the labels of the layers at one voxel one after another.
std::string label_bytes(const LabelMap& map, std::size_t width) {
  std::string bytes;
  bytes.reserve(map.voxel_count() * map.layers.size() * width);
  for (std::size_t voxel = 0; voxel < map.voxel_count(); ++voxel) {
    for (const auto& layer : map.layers) {
      const std::uint16_t label = layer[voxel];
      bytes += static_cast<char>(label & 0xff);
      if (width == 2) bytes += static_cast<char>(label >> 8);
    }
  }
  return bytes;
}

std::string nrrd_of(const fs::path& path, const LabelMap& map) {
  const std::size_t width = bytes_per_label(map);
  NrrdContent content{width == 1 ? "uint8" : "uint16", true};
  content.values = static_cast<Index>(map.layers.size());
  content.keys = segment_keys(map);
  return nrrd_header(map, content) + gzipped(path, label_bytes(map, width));
}

std::string nifti_of(const fs::path& path, const LabelMap& map) {
  constexpr Index kMostAlongAxis = 32767;
  if (map.layers.size() > 1) {
    refuse(path, message("cannot be written: expected one layer in a NIfTI file, found ",
                         map.layers.size(), " (overlapping segments need .seg.nrrd)"));
  }
  if (std::max({map.size[0], map.size[1], map.size[2]}) > kMostAlongAxis) {
    refuse(path, message("cannot be written: expected at most ", kMostAlongAxis,
                         " voxels along an axis in a NIfTI file, found ", map.size[0], " x ",
                         map.size[1], " x ", map.size[2]));
  }
  const std::size_t width = bytes_per_label(map);
  return nifti_header(map, width, caret_extension(map.segments)) + label_bytes(map, width);
}

void write(const OutputPath& path, const LabelMap& map) {
  const std::string name = lower(path.filename().string());
  if (name.ends_with(".nrrd")) {
    write_file(path, nrrd_of(path, map));
  } else if (name.ends_with(".nii")) {
    write_file(path, nifti_of(path, map));
  } else if (name.ends_with(".nii.gz")) {
    write_file(path, gzipped(path, nifti_of(path, map)));
  } else {
    refuse(path,
           "cannot be written: expected a name that ends with .nii, .nii.gz, .nrrd or "
           ".seg.nrrd");
  }
}

}  // namespace

void write_label_map(const OutputPath& path, const LabelMap& map) {
  try {
    require_valid(map);
  } catch (const InputError& error) {
    refuse(path, message("cannot be written: ", error.what()));
  }
  write(path, map);
}

}  // namespace mesamis::detail::label_files
