// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/volume_files/dicom_slice.h"

/// Slices grouped into series and stacks, and the choice of one series.
namespace mesamis::detail::volume_files {

/// Slices of one orientation, size and pixel spacing, in the order of the files.
using DicomStack = std::vector<DicomSlice>;

struct DicomSeries {
  std::string uid, description, modality, frame_of_reference;
  std::vector<DicomStack> stacks;  ///< one, unless there is a problem; without localizers
  std::size_t frames = 0;          ///< of all stacks, localizers and broken files included
  std::string problem;             ///< of a file or of the stacks, a whole line; empty: none
  std::vector<std::string> warnings;
};

/// Groups images by their series UID, in the order in which the UIDs come.
///
/// Files that are copies, of one SOP Instance UID, place and content, count once, with a warning. So
/// do those of one place that differ in their transfer syntax alone, by SOP Instance UID or by what
/// tells phases and Instance Number: one that is not lossy is kept before one that is.
/// Within a series, slices are grouped into stacks. Localizers are left out with a warning:
/// slices that call themselves so where others do not, and a stack across the main one that is
/// single or has at most a quarter of its slices. Two larger stacks are a problem.
/// @param images  those without pixels are skipped.
///
/// O(slices * stacks).
std::vector<DicomSeries> group_by_series(const std::vector<DicomImage>& images);

/// Chooses the series with the given UID; for an empty UID the only series, or the only one that
/// has at least two slices.
/// @param path  begins the message.
/// @throws InputError  if there is none or the choice is open; the message lists what there is.
const DicomSeries& choose_series(const std::filesystem::path& path,
                                 const std::vector<DicomSeries>& all, const std::string& uid);

/// UID, modality, description and number of slices of each, up to 20.
std::string titles_of(const std::vector<DicomSeries>& all);

}  // namespace mesamis::detail::volume_files
