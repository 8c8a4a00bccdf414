// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_slice.h"

#include <array>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/dicom_phases.h"

namespace mesamis::detail::volume_files {
namespace {

/// The data sets that describe one frame: its own functional groups, those shared by all frames,
/// the file's top level, and the detector of nuclear medicine, in this order.
class FrameTags {
 public:
  FrameTags(const DicomFile& file, std::size_t frame) : file_(file) {
    const auto groups = file.elements.find(dicom::kFrameGroups);
    const bool own = groups != file.elements.end() && frame < groups->second.items.size();
    own_ = own ? &groups->second.items[frame] : nullptr;
    shared_ = first_item(file.elements, dicom::kSharedGroups);
  }

  /// The data set in which a tag of the group `macro` lies; the file's top level if in none.
  const DicomSet& set_with(const MacroTag& tag) const {
    for (const DicomSet* groups : {own_, shared_}) {
      const DicomSet* item = groups ? first_item(*groups, tag.macro) : nullptr;
      if (item && item->count(tag.tag)) return *item;
    }
    const DicomSet* detector = first_item(file_.elements, dicom::kDetectors);
    return !file_.elements.count(tag.tag) && detector ? *detector : file_.elements;
  }
  bool has(const MacroTag& tag) const { return set_with(tag).count(tag.tag) > 0; }
  std::string text(const MacroTag& tag) const { return text_of(set_with(tag), tag.tag); }
  std::optional<std::vector<double>> find(const MacroTag& tag, std::size_t count) const {
    return decimals_of(set_with(tag), tag.tag, count);
  }
  /// @param hint  what else gives the numbers; ends the message.
  std::vector<double> need(const MacroTag& tag, std::size_t count, const char* name,
                           const char* hint = "") const {
    const auto numbers = find(tag, count);
    if (!numbers) {
      const std::string found = text(tag);
      refuse(file_.path,
             message("expected ", count, count == 1 ? " number as " : " numbers as ", name,
                     ", found ", found.empty() ? "none" : in_quotes(found), hint));
    }
    for (const double number : *numbers) {
      if (!std::isfinite(number)) refuse(file_.path, message(name, " holds ", number));
    }
    return *numbers;
  }

 private:
  const DicomFile& file_;
  const DicomSet* own_;
  const DicomSet* shared_;
};

constexpr MacroTag kPositionTag{dicom::kPlanePosition, dicom::kPosition},
    kOrientationTag{dicom::kPlaneOrientation, dicom::kOrientation},
    kSpacingTag{dicom::kPixelMeasures, dicom::kPixelSpacing};

void orient(DicomSlice& slice, const FrameTags& tags) {
  const auto o = tags.need(kOrientationTag, 6, "Image Orientation (0020,0037)");
  slice.along_row = {o[0], o[1], o[2]};
  slice.along_column = {o[3], o[4], o[5]};
  constexpr double kUnitTolerance = 0.01;  // cosines are sometimes written with two digits
  for (const Vec3& direction : {slice.along_row, slice.along_column}) {
    if (!(std::abs(norm(direction) - 1) <= kUnitTolerance)) {
      refuse(slice.file, message("expected an Image Orientation of unit vectors, found length ",
                                 norm(direction)));
    }
  }
}

void place_in_plane(DicomSlice& slice, const FrameTags& tags) {
  constexpr const char* kHint = " (--spacing X,Y,Z takes slices in the order of Instance Numbers)";
  const auto p = tags.need(kPositionTag, 3, "Image Position (0020,0032)", kHint);
  slice.position = {p[0], p[1], p[2]};
  orient(slice, tags);
}

/// A number that tells the order of slices without a position; none if there is none.
std::optional<double> order_of(const DicomFile& file, const std::optional<Vec3>& spacing,
                               DicomSlice& slice) {
  if (const auto location = decimals_of(file.elements, dicom::kSliceLocation, 1)) {
    slice.placed_by = PlacedBy::kLocation;
    return location->front();
  }
  const auto number = decimals_of(file.elements, dicom::kInstanceNumber, 1);
  if (!number || !spacing) return std::nullopt;
  slice.placed_by = PlacedBy::kNumber;
  return spacing->z * number->front();
}

void place(DicomSlice& slice, const DicomFile& file, const FrameTags& tags,
           const std::optional<Vec3>& spacing) {
  const auto height = tags.has(kPositionTag) ? std::nullopt : order_of(file, spacing, slice);
  if (!height || !std::isfinite(*height)) return place_in_plane(slice, tags);
  slice.oriented = tags.has(kOrientationTag);
  if (slice.oriented) {
    orient(slice, tags);
  } else {
    slice.along_row = {1, 0, 0};
    slice.along_column = {0, 1, 0};
  }
  slice.position = *height * unit_or_zero(cross(slice.along_row, slice.along_column));
}

/// Distances of rows and columns.
void set_pixel_size(DicomSlice& slice, const FrameTags& tags, const std::optional<Vec3>& spacing) {
  const auto usable = [](const auto& s) {
    return s && std::isfinite((*s)[0]) && std::isfinite((*s)[1]) && (*s)[0] > 0 && (*s)[1] > 0;
  };
  if (spacing && !usable(tags.find(kSpacingTag, 2))) {
    slice.row_step = spacing->y;
    slice.column_step = spacing->x;
    return;
  }
  const auto s =
      tags.need(kSpacingTag, 2, "Pixel Spacing (0028,0030)", " (--spacing X,Y,Z replaces it)");
  slice.row_step = s[0];
  slice.column_step = s[1];
  if (!(s[0] > 0) || !(s[1] > 0)) {
    refuse(slice.file, message("expected a positive Pixel Spacing, found ", s[0], " x ", s[1],
                               " (--spacing X,Y,Z replaces it)"));
  }
}

void scale(DicomSlice& slice, const FrameTags& tags) {
  const auto slope = tags.find({dicom::kPixelTransformation, dicom::kSlope}, 1);
  const auto intercept = tags.find({dicom::kPixelTransformation, dicom::kIntercept}, 1);
  slice.rescaled = slope || intercept;
  if (slope) slice.slope = slope->front();
  if (intercept) slice.intercept = intercept->front();
  if (const auto dose = tags.find({dicom::kPixelTransformation, dicom::kDoseScaling}, 1)) {
    slice.slope *= dose->front();
  }
  if (slice.slope == 0 || !std::isfinite(slice.slope) || !std::isfinite(slice.intercept)) {
    refuse(slice.file, message("expected a usable rescale, found slope ", slice.slope,
                               ", intercept ", slice.intercept));
  }
}

/// What the frames of a file are stacked by, where no group places each.
struct FrameStack {
  std::vector<double> heights;  ///< mm along the normal, from the first
  std::string from;             ///< what tells them
};

/// The spacing that a file without positions of its frames gives them.
std::optional<double> stated_step(const DicomFile& file, std::string& from) {
  const std::array<std::pair<DicomTag, const char*>, 2> tags{
      {{dicom::kSliceSpacing, "Spacing Between Slices"},
       {dicom::kSliceThickness, "Slice Thickness"}}};
  for (const auto& [tag, name] : tags) {
    const auto step = decimals_of(file.elements, tag, 1);
    if (!step || !std::isfinite(step->front()) || step->front() == 0) continue;
    from = name;
    return step->front();
  }
  return std::nullopt;
}

/// Frames that differ in time are no stack.
void require_no_times(const DicomFile& file) {
  const auto pointer = numbers_of(file, file.elements, dicom::kFrameIncrement, 2);
  if (!pointer) return;
  constexpr int kTimes = 0x0018, kFrameTime = 0x1063, kFrameTimes = 0x1065;
  const bool times =
      (*pointer)[0] == kTimes && ((*pointer)[1] == kFrameTime || (*pointer)[1] == kFrameTimes);
  if (times) {
    refuse(file.path,
           "expected frames at different places, found frames at different times (Frame Increment "
           "Pointer)");
  }
}

FrameStack stack_of_frames(const DicomFile& file, std::size_t frames,
                           const std::optional<Vec3>& spacing) {
  FrameStack stack;
  if (const auto offsets = decimals_of(file.elements, dicom::kFrameOffsets, frames)) {
    stack.from = "Grid Frame Offset Vector";
    for (const double offset : *offsets) stack.heights.push_back(offset - offsets->front());
    return stack;
  }
  require_no_times(file);
  auto step = stated_step(file, stack.from);
  if (!step && spacing) step = spacing->z;
  if (!step) {
    refuse(file.path,
           message("expected a position for each of the ", frames,
                   " frames, found neither Per-frame Functional Groups nor Spacing Between "
                   "Slices or Slice Thickness (--spacing X,Y,Z gives it)"));
  }
  for (std::size_t n = 0; n < frames; ++n) {
    stack.heights.push_back(*step * static_cast<double>(n));
  }
  return stack;
}

/// Moves the frames of a file along their normal.
std::string stack_frames(const DicomFile& file, std::vector<DicomSlice>& slices,
                         const std::optional<Vec3>& spacing) {
  const FrameStack stack = stack_of_frames(file, slices.size(), spacing);
  const DicomSlice& first = slices.front();
  const Vec3 normal = unit_or_zero(cross(first.along_row, first.along_column));
  for (std::size_t n = 0; n < slices.size(); ++n) {
    slices[n].position += stack.heights[n] * normal;
  }
  return message(
      "the frames have no positions of their own: stacked in their order along the normal, by ",
      stack.from.empty() ? "the spacing given" : stack.from);
}

/// A file of frames without places of their own may lack even that of the first.
bool lies_nowhere(const DicomFile& file) {
  const FrameTags tags(file, 0);
  return !tags.has(kPositionTag) && !tags.has(kOrientationTag) &&
         file.elements.count(dicom::kSliceLocation) == 0;
}

/// A frame without a place.
DicomSlice unplaced_frame(const DicomFile& file, const DicomPixels& pixels, std::size_t frame) {
  DicomSlice slice;
  slice.file = file.path;
  slice.frame = static_cast<int>(frame);
  slice.columns = pixels.columns;
  slice.rows = pixels.rows;
  return slice;
}

DicomSlice frame_along_lps(const DicomFile& file, const DicomPixels& pixels, std::size_t frame,
                           const std::optional<Vec3>& spacing) {
  DicomSlice slice = unplaced_frame(file, pixels, frame);
  slice.along_row = {1, 0, 0};
  slice.along_column = {0, 1, 0};
  set_pixel_size(slice, FrameTags(file, frame), spacing);
  return slice;
}

void set_slices(const DicomFile& file, MemoryBudget& budget, const std::optional<Vec3>& spacing,
                DicomImage& image) {
  const DicomPixels pixels = pixels_of(file);
  const std::string type = text_of(file.elements, dicom::kImageType);
  if (type.find("MOSAIC") != std::string::npos) {
    refuse(file.path, "expected one slice per picture, found a mosaic");
  }
  budget.claim(static_cast<std::uint64_t>(pixels.frames),
               sizeof(DicomSlice) + file.path.native().size(), "DICOM slices");
  const bool stacked = pixels.frames > 1 && !file.elements.count(dicom::kFrameGroups);
  const bool nowhere = stacked && lies_nowhere(file);
  std::vector<DicomSlice> slices(static_cast<std::size_t>(pixels.frames));
  for (std::size_t frame = 0; frame < slices.size(); ++frame) {
    slices[frame] = nowhere ? frame_along_lps(file, pixels, frame, spacing)
                            : place_frame(file, pixels, frame, spacing);
    slices[frame].localizer = type.find("LOCALIZER") != std::string::npos;
    slices[frame].phase = phase_marks(file, frame);
    scale(slices[frame], FrameTags(file, frame));
  }
  if (stacked) {
    image.warning = stack_frames(file, slices, spacing);
    if (nowhere) image.warning += "; the file gives no orientation: axes taken as LPS";
  }
  image.slices = std::move(slices);
}

/// Equal for files with the same pixels.
std::size_t content_of(const DicomFile& file) {
  const auto pixels = file.elements.find(dicom::kPixelData);
  if (pixels == file.elements.end()) return 0;
  const auto hash = [](Bytes bytes) {
    return std::hash<std::string_view>{}(
        {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  std::size_t all = hash(pixels->second.value);
  for (const Bytes fragment : pixels->second.fragments) all = 31 * all + hash(fragment);
  return all;
}

/// By its own word or its transfer syntax: JPEG baseline and extended, JPEG-LS near-lossless, and
/// JPEG 2000 that need not be lossless.
bool is_lossy(const DicomFile& file) {
  constexpr std::string_view kJpeg = "1.2.840.10008.1.2.4.";
  const std::string_view syntax = file.transfer_syntax;
  if (text_of(file.elements, dicom::kLossy) == "01") return true;
  if (!syntax.starts_with(kJpeg)) return false;
  const std::string_view kind = syntax.substr(kJpeg.size());
  return kind == "50" || kind == "51" || kind == "53" || kind == "55" || kind == "81" ||
         kind == "91";
}

}  // namespace

DicomSlice place_frame(const DicomFile& file, const DicomPixels& pixels, std::size_t frame,
                       const std::optional<Vec3>& spacing) {
  DicomSlice slice = unplaced_frame(file, pixels, frame);
  const FrameTags tags(file, frame);
  place(slice, file, tags, spacing);
  set_pixel_size(slice, tags, spacing);
  return slice;
}

std::optional<std::vector<double>> frame_decimals(const DicomFile& file, std::size_t frame,
                                                  const MacroTag& tag, std::size_t count) {
  return FrameTags(file, frame).find(tag, count);
}

std::string frame_text(const DicomFile& file, std::size_t frame, const MacroTag& tag) {
  return FrameTags(file, frame).text(tag);
}

Bytes frame_bytes(const DicomFile& file, std::size_t frame, const MacroTag& tag) {
  const DicomSet& set = FrameTags(file, frame).set_with(tag);
  const auto element = set.find(tag.tag);
  return element == set.end() ? Bytes{} : element->second.value;
}

std::array<Vec3, 3> grid_steps(const DicomSlice& slice, const Vec3& up) noexcept {
  return {slice.column_step * unit_or_zero(slice.along_row),
          slice.row_step * unit_or_zero(slice.along_column), up};
}

std::string name_of(const DicomSlice& slice) {
  const std::string name = slice.file.filename().string();
  return slice.frame > 0 ? message(name, " frame ", slice.frame) : name;
}

DicomImage describe_image(const DicomFile& file, MemoryBudget& budget,
                          const std::optional<Vec3>& spacing) {
  DicomImage image;
  const DicomSet& set = file.elements;
  image.file = file.path;
  image.series = text_of(set, dicom::kSeriesUid);
  image.description = shown(text_of(set, dicom::kSeriesDescription));
  image.modality = shown(text_of(set, dicom::kModality));
  image.frame_of_reference = shown(text_of(set, dicom::kFrameOfReference));
  image.instance = text_of(set, dicom::kSopInstance);
  image.has_pixels = !file.problem.empty() || set.count(dicom::kRows) ||
                     set.count(dicom::kPixelData) || set.count(dicom::kFloatPixelData) ||
                     set.count(dicom::kDoublePixelData);
  if (!image.has_pixels) return image;
  image.content = content_of(file);
  image.transfer_syntax = file.transfer_syntax;
  image.lossy = is_lossy(file);
  if (text_of(set, dicom::kPhotometric) == "MONOCHROME1") {
    image.warning = "MONOCHROME1: meant to be shown inverted; the values are kept as stored";
  }
  try {
    if (!file.problem.empty()) refuse(file.path, "broken DICOM file: " + file.problem);
    set_slices(file, budget, spacing, image);
  } catch (const InputError& error) {
    image.problem = error.what();
  }
  return image;
}

}  // namespace mesamis::detail::volume_files
