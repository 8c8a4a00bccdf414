// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/dicom_slice.h"

#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail {
namespace {

/// The data sets that describe one frame: its own functional groups, those shared by all frames,
/// and the file's top level, in this order.
class FrameTags {
 public:
  FrameTags(const DicomFile& file, std::size_t frame) : file_(file) {
    const auto groups = file.elements.find(dicom::kFrameGroups);
    const bool own = groups != file.elements.end() && frame < groups->second.items.size();
    own_ = own ? &groups->second.items[frame] : nullptr;
    shared_ = first_item(file.elements, dicom::kSharedGroups);
  }

  /// `count` decimals of a tag that lies in the group `macro` of an enhanced file.
  std::optional<std::vector<double>> find(DicomTag macro, DicomTag tag, std::size_t count) const {
    for (const DicomSet* groups : {own_, shared_}) {
      const DicomSet* item = groups ? first_item(*groups, macro) : nullptr;
      if (item && item->count(tag)) return decimals_of(*item, tag, count);
    }
    return decimals_of(file_.elements, tag, count);
  }
  std::vector<double> need(DicomTag macro, DicomTag tag, std::size_t count,
                           const char* name) const {
    const auto numbers = find(macro, tag, count);
    if (!numbers) refuse(file_.path, say("expected ", count, " numbers as ", name, ", found none"));
    for (const double number : *numbers) {
      if (!std::isfinite(number)) refuse(file_.path, say(name, " holds ", number));
    }
    return *numbers;
  }

 private:
  const DicomFile& file_;
  const DicomSet* own_;
  const DicomSet* shared_;
};

void place(DicomSlice& slice, const FrameTags& tags) {
  const auto p =
      tags.need(dicom::kPlanePosition, dicom::kPosition, 3, "Image Position (0020,0032)");
  const auto o =
      tags.need(dicom::kPlaneOrientation, dicom::kOrientation, 6, "Image Orientation (0020,0037)");
  const auto s =
      tags.need(dicom::kPixelMeasures, dicom::kPixelSpacing, 2, "Pixel Spacing (0028,0030)");
  slice.position = {p[0], p[1], p[2]};
  slice.along_row = {o[0], o[1], o[2]};
  slice.along_column = {o[3], o[4], o[5]};
  slice.row_step = s[0];
  slice.column_step = s[1];
  if (!(s[0] > 0) || !(s[1] > 0)) {
    refuse(slice.file, say("expected a positive Pixel Spacing, found ", s[0], " x ", s[1]));
  }
  constexpr double kUnitTolerance = 0.01;  // cosines are sometimes written with two digits
  for (const Vec3& direction : {slice.along_row, slice.along_column}) {
    if (!(std::abs(norm(direction) - 1) <= kUnitTolerance)) {
      refuse(slice.file,
             say("expected an Image Orientation of unit vectors, found length ", norm(direction)));
    }
  }
}

void scale(DicomSlice& slice, const FrameTags& tags) {
  const auto slope = tags.find(dicom::kPixelTransformation, dicom::kSlope, 1);
  const auto intercept = tags.find(dicom::kPixelTransformation, dicom::kIntercept, 1);
  if (slope) slice.slope = slope->front();
  if (intercept) slice.intercept = intercept->front();
  if (slice.slope == 0 || !std::isfinite(slice.slope) || !std::isfinite(slice.intercept)) {
    refuse(slice.file, say("expected a usable rescale, found slope ", slice.slope, ", intercept ",
                           slice.intercept));
  }
}

std::vector<DicomSlice> slices_of(const DicomFile& file, MemoryBudget& budget) {
  const DicomPixels pixels = pixels_of(file);
  const std::string type = text_of(file.elements, dicom::kImageType);
  if (type.find("MOSAIC") != std::string::npos) {
    refuse(file.path, "a mosaic of many slices in one picture is not read");
  }
  if (pixels.frames > 1 && !file.elements.count(dicom::kFrameGroups)) {
    refuse(file.path, say("expected a position for each of the ", pixels.frames,
                          " frames, found none (no Per-frame Functional Groups)"));
  }
  budget.claim(static_cast<std::uint64_t>(pixels.frames),
               sizeof(DicomSlice) + file.path.native().size(), "DICOM slices");
  std::vector<DicomSlice> slices(static_cast<std::size_t>(pixels.frames));
  for (std::size_t frame = 0; frame < slices.size(); ++frame) {
    slices[frame] = place_frame(file, pixels, frame);
    slices[frame].localizer = type.find("LOCALIZER") != std::string::npos;
    scale(slices[frame], FrameTags(file, frame));
  }
  return slices;
}

}  // namespace

DicomSlice place_frame(const DicomFile& file, const DicomPixels& pixels, std::size_t frame) {
  DicomSlice slice;
  slice.file = file.path;
  slice.frame = static_cast<int>(frame);
  slice.columns = pixels.columns;
  slice.rows = pixels.rows;
  place(slice, FrameTags(file, frame));
  return slice;
}

std::optional<std::vector<double>> frame_decimals(const DicomFile& file, std::size_t frame,
                                                  const MacroTag& tag, std::size_t count) {
  return FrameTags(file, frame).find(tag.macro, tag.tag, count);
}

std::array<Vec3, 3> grid_steps(const DicomSlice& slice, const Vec3& up) noexcept {
  return {slice.column_step * unit_or_zero(slice.along_row),
          slice.row_step * unit_or_zero(slice.along_column), up};
}

std::string name_of(const DicomSlice& slice) {
  const std::string name = slice.file.filename().string();
  return slice.frame > 0 ? say(name, " frame ", slice.frame) : name;
}

DicomImage describe_image(const DicomFile& file, MemoryBudget& budget) {
  DicomImage image;
  const DicomSet& set = file.elements;
  image.file = file.path;
  image.series = text_of(set, dicom::kSeriesUid);
  image.description = shown(text_of(set, dicom::kSeriesDescription));
  image.modality = shown(text_of(set, dicom::kModality));
  image.frame_of_reference = shown(text_of(set, dicom::kFrameOfReference));
  image.has_pixels = !file.problem.empty() || set.count(dicom::kRows) ||
                     set.count(dicom::kPixelData) || set.count(dicom::kFloatPixelData) ||
                     set.count(dicom::kDoublePixelData);
  if (!image.has_pixels) return image;
  try {
    if (!file.problem.empty()) refuse(file.path, "broken DICOM file: " + file.problem);
    image.slices = slices_of(file, budget);
  } catch (const InputError& error) {
    image.problem = error.what();
  }
  if (text_of(set, dicom::kPhotometric) == "MONOCHROME1") {
    image.warning = "MONOCHROME1: meant to be shown inverted; the values are kept as stored";
  }
  return image;
}

}  // namespace mesamis::detail
