// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/files/dicom_data.h"
#include "mesamis/volume_files/dicom_pixels.h"

namespace mesamis::detail::volume_files {

/// What tells where a slice lies.
enum class PlacedBy {
  kPosition,  ///< Image Position
  kLocation,  ///< Slice Location: heights along the normal of the slices
  kNumber,    ///< Instance Number: its order, one step of the given spacing each
};

/// One frame: where its samples are and where it lies in space. LPS, mm.
struct DicomSlice {
  std::filesystem::path file;
  int frame = 0;  ///< 0 for a file of one image
  int columns = 0, rows = 0;
  Vec3 along_row, along_column;  ///< directions in which the column and row numbers grow
  Vec3 position;                 ///< centre of the first pixel
  double column_step = 1, row_step = 1;
  double slope = 1, intercept = 0;
  bool rescaled = false;   ///< the file states the slope or the intercept
  bool localizer = false;  ///< its Image Type says LOCALIZER
  PlacedBy placed_by = PlacedBy::kPosition;
  bool oriented = true;  ///< false: the directions are taken as LPS
  std::string phase{};   ///< by what slices at one place may differ, see phase_marks()
};

/// A tag and the functional group of an enhanced file in which it lies.
struct MacroTag {
  DicomTag macro, tag;
};

/// The slices of one file and the series they belong to.
struct DicomImage {
  std::filesystem::path file;
  std::string series, description, modality, frame_of_reference;
  bool has_pixels = false;         ///< false: a report, a plan, a structure set
  std::vector<DicomSlice> slices;  ///< empty if there is a problem
  std::string problem;             ///< the whole line; empty: none
  std::string warning;
  std::string instance{};   ///< SOP Instance UID
  std::size_t content = 0;  ///< a hash of the pixel data, equal for copies
  std::string transfer_syntax{};
  bool lossy = false;  ///< its pixels were compressed with loss, now or before
};

/// Places one frame, from 0, of a file of pixels: all of a DicomSlice but rescale, localizer and
/// phase.
///
/// A file without a position lies at its Slice Location, or, where a spacing is given, at its
/// Instance Number: along the normal of its orientation, or in axes along LPS where it has none.
/// @param pixels   pixels_of(file).
/// @param spacing  mm, given by the user: taken where the file's cannot be used.
/// @throws InputError  if position, orientation or spacing are missing or cannot be used.
DicomSlice place_frame(const DicomFile& file, const DicomPixels& pixels, std::size_t frame,
                       const std::optional<Vec3>& spacing = {});

/// The text of a tag that lies in the group `macro`, found as frame_decimals() finds it.
std::string frame_text(const DicomFile& file, std::size_t frame, const MacroTag& tag);
/// The bytes of the same, in the file's order: none if the tag is not there.
Bytes frame_bytes(const DicomFile& file, std::size_t frame, const MacroTag& tag);

/// `count` decimals of a tag that lies in the group `macro`: of the frame's own functional groups,
/// else of those shared by all frames, else of the top level of the file.
std::optional<std::vector<double>> frame_decimals(const DicomFile& file, std::size_t frame,
                                                  const MacroTag& tag, std::size_t count);

/// Reads everything but the samples. `problem` describes content that cannot be used; nothing is
/// thrown for it.
/// @param budget   the slices are claimed, and held.
/// @param spacing  as place_frame().
DicomImage describe_image(const DicomFile& file, MemoryBudget& budget,
                          const std::optional<Vec3>& spacing = {});

/// The steps from column to column, from row to row and from slice to slice, LPS, mm: what
/// set_axes() takes.
/// @param up  the step from slice to slice, LPS, mm.
std::array<Vec3, 3> grid_steps(const DicomSlice& slice, const Vec3& up) noexcept;

/// "IM0001.dcm", "IM0001.dcm frame 3": how messages name a slice.
std::string name_of(const DicomSlice& slice);

}  // namespace mesamis::detail::volume_files
