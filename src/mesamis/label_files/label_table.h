// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "mesamis/files/output_path.h"
#include "mesamis/image/label_map.h"
#include "mesamis/rooms.h"

/// Tables of labels in files of their own; with_names() applies one to a label map.
namespace mesamis::detail::label_files {

/// Reads a label description of ITK-SNAP (.label, .txt: IDX R G B A VIS MSH "NAME") or a colour
/// table of 3D Slicer (.ctbl, .txt: IDX NAME R G B A), one label per line.
///
/// Lines that begin with # and the label 0 are left out. A name is one word or stands in quotes.
/// The colour of the second form is optional, and so is its opacity; colours are whole numbers of 0
/// to 255.
/// @return one segment per line, all of layer 0. A number above 65535, as atlases have them, is the
///         segment's number_in_file, and its label is 0: with_names() finds it.
/// @throws InputError  naming the line, for anything else and for a label that comes twice; for a
///                     file above 16 MiB.
///
/// O(bytes), up to a logarithm.
std::vector<Segment> read_label_table(const std::filesystem::path& path);

/// Writes the segments of a label map as a label description of ITK-SNAP. Quotes and control
/// characters of names are replaced. The file appears whole or not at all.
/// @param path      any name; ITK-SNAP expects .label or .txt.
/// @param segments  labels of 1 to 65535.
/// @throws InputError  for two segments of one label (in different layers), a label out of range,
///                     and if the file cannot be written.
///
/// O(segments), up to a logarithm.
void write_label_table(const OutputPath& path, std::span<const Segment> segments);

}  // namespace mesamis::detail::label_files
