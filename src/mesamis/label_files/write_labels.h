// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/files/output_path.h"
#include "mesamis/image/label_map.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::label_files {

/// Writes a label map as .nii, .nii.gz, .nrrd or .seg.nrrd; read_label_map() reads it back with the
/// same labels, layers and segments.
///
/// Samples are unsigned, of 8 bits if all labels fit, else of 16. The file appears whole or not at
/// all. The same map gives the same bytes. .nrrd and .seg.nrrd are gzipped, have the fields of 3D
/// Slicer's segmentations and a list axis for more than one layer; Slicer shows a .seg.nrrd as a
/// segmentation. .nii (NIfTI-1, RAS) has one layer; a CaretExtension in its header holds names and
/// colours. Its sform and qform are in single precision. ITK-SNAP reads names from
/// write_label_table()'s file only.
/// @param path  the extension decides.
/// @param map   valid, see require_valid().
/// @throws InputError  for another extension, a map that is not valid or, for .nii, has several
///                     layers or more than 32767 voxels along an axis, and if the file cannot be
///                     written.
///
/// O(voxels * layers). Memory: the samples once, gzipped twice.
void write_label_map(const OutputPath& path, const LabelMap& map);

}  // namespace mesamis::detail::label_files
