// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/seg_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/dicom_slice.h"
#include "mesamis/volume_files/dicom_spacing.h"
#include "mesamis/volume_files/scan_file.h"

namespace mesamis::detail::label_files {
namespace {

constexpr double kSameDirection = 1e-3;  // of unit vectors
constexpr double kSameSpacing = 1e-3;    // relative

std::string frame_text(std::size_t frame) { return message("frame ", frame + 1); }

Vec3 normal_of(const DicomSlice& slice) {
  return unit_or_zero(cross(slice.along_row, slice.along_column));
}

void require_same_plane(const DicomFile& file, const DicomSlice& first, const DicomSlice& slice) {
  const auto frame = static_cast<std::size_t>(slice.frame);
  const double turned = std::max(norm(slice.along_row - first.along_row),
                                 norm(slice.along_column - first.along_column));
  if (!(turned <= kSameDirection)) {
    refuse(file.path, message("expected one orientation of all frames, found ", frame_text(frame),
                              " turned by ", turned, " against frame 1"));
  }
  const auto differs = [](double a, double b) { return !(std::abs(a - b) <= kSameSpacing * a); };
  if (differs(first.row_step, slice.row_step) || differs(first.column_step, slice.column_step)) {
    refuse(file.path, message("expected the pixel spacing ", first.row_step, " x ",
                              first.column_step, " mm of all frames, found ", slice.row_step, " x ",
                              slice.column_step, " mm in ", frame_text(frame)));
  }
  const Vec3 away = slice.position - first.position, n = normal_of(first);
  const double shift = norm(away - dot(away, n) * n);
  if (!(shift <= kDriftTolerance * std::min(first.row_step, first.column_step))) {
    refuse(file.path, message("expected frames straight above one another, found ",
                              frame_text(frame), " shifted by ", shift, " mm against frame 1"));
  }
}

/// A frame and its height along the normal above frame 1, mm.
struct Height {
  double mm;
  std::size_t frame;
};

/// In ascending order.
std::vector<Height> heights_of(const DicomFile& file, const DicomPixels& pixels) {
  const DicomSlice first = place_frame(file, pixels, 0);
  const double skew = std::abs(dot(first.along_row, first.along_column));
  if (!(skew <= kSkewTolerance)) {
    refuse(file.path,
           message("expected rows and columns at right angles, found a cosine of ", skew));
  }
  const Vec3 n = normal_of(first);
  std::vector<Height> heights;
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(pixels.frames); ++frame) {
    const DicomSlice slice = place_frame(file, pixels, frame);
    require_same_plane(file, first, slice);
    heights.push_back({dot(slice.position - first.position, n), frame});
  }
  std::stable_sort(heights.begin(), heights.end(),
                   [](const Height& a, const Height& b) { return a.mm < b.mm; });
  return heights;
}

/// Two frames no farther apart than this lie at one position.
bool same_position(double gap) { return gap <= 10 * kDuplicateDistance; }

std::optional<double> positive(const DicomFile& file, DicomTag tag) {
  const auto value = frame_decimals(file, 0, {dicom::kPixelMeasures, tag}, 1);
  if (!value || !(value->front() > 0) || !std::isfinite(value->front())) return std::nullopt;
  return value->front();
}

/// The steps from one frame to the next, the mean step, and the worst of the gaps.
struct Fit {
  std::vector<double> steps;  // whole numbers
  double step = 0;            // mm
  double error = 0;           // of a gap, in steps
  std::size_t worst = 0;      // its upper frame, among the heights
};

/// The gaps as whole multiples of a step, which is then adjusted to all of them.
Fit fit_step(const std::vector<Height>& heights, double step) {
  Fit fit{{0}, step, 0, 0};
  double total = 0;
  for (std::size_t n = 1; n < heights.size(); ++n) {
    const double gap = heights[n].mm - heights[n - 1].mm;
    fit.steps.push_back(same_position(gap) ? 0 : std::max(1.0, std::round(gap / step)));
    total += fit.steps.back();
  }
  if (total > 0) fit.step = (heights.back().mm - heights.front().mm) / total;
  for (std::size_t n = 1; n < heights.size(); ++n) {
    const double gap = heights[n].mm - heights[n - 1].mm;
    const double error = std::abs(gap / fit.step - fit.steps[n]);
    if (error > fit.error && !same_position(gap)) fit.error = error, fit.worst = n;
  }
  return fit;
}

double least_gap(const std::vector<Height>& heights) {
  double least = 0;
  for (std::size_t n = 1; n < heights.size(); ++n) {
    const double gap = heights[n].mm - heights[n - 1].mm;
    if (!same_position(gap) && (least == 0 || gap < least)) least = gap;
  }
  return least;
}

Fit find_steps(const DicomFile& file, const std::vector<Height>& heights) {
  const auto stated = positive(file, dicom::kSliceSpacing);
  const double least = least_gap(heights);
  if (least == 0) {
    const auto step = stated ? stated : positive(file, dicom::kSliceThickness);
    if (!step) {
      refuse(file.path,
             "expected a Spacing Between Slices (0018,0088) for frames at one position, "
             "found none");
    }
    return fit_step(heights, *step);
  }
  Fit fit = fit_step(heights, stated.value_or(least));
  if (stated && fit.error > kStepTolerance) fit = fit_step(heights, least);
  if (fit.error > kStepTolerance) {
    const Height &below = heights[fit.worst - 1], &above = heights[fit.worst];
    refuse(file.path, message("expected positions of a regular grid, a multiple of ", fit.step,
                              " mm apart, found ", above.mm - below.mm, " mm between ",
                              frame_text(below.frame), " and ", frame_text(above.frame)));
  }
  return fit;
}

}  // namespace

SegGrid grid_of_frames(const DicomFile& file, const DicomPixels& pixels) {
  const std::vector<Height> heights = heights_of(file, pixels);
  const Fit fit = find_steps(file, heights);
  SegGrid out;
  out.slice.resize(heights.size());
  double slice = 0;
  for (std::size_t n = 0; n < heights.size(); ++n) {
    slice += fit.steps[n];
    if (slice > 1e9) refuse(file.path, message("more slices than can be read: ", slice));
    out.slice[heights[n].frame] = static_cast<Index>(slice);
  }
  const DicomSlice lowest = place_frame(file, pixels, heights[0].frame);
  ScanFile scan{file.path, "DICOM", {}, {}, {}};
  set_size(scan, {pixels.columns, pixels.rows, static_cast<std::int64_t>(slice) + 1});
  set_axes(scan, grid_steps(lowest, fit.step * normal_of(lowest)));
  set_origin(scan, lowest.position);
  out.grid = scan.grid;
  require_voxels(file, out.grid, 1);
  return out;
}

void require_voxels(const DicomFile& file, const VoxelGrid& grid, std::size_t layers) {
  constexpr std::uint64_t kMostPerByte = 8192;
  const std::uint64_t bytes = size_of(file.path);
  const std::uint64_t per_layer = grid.voxel_count();
  if (layers <= bytes * kMostPerByte / per_layer) return;
  refuse(file.path,
         message("expected at most ", kMostPerByte, " voxels per byte of the file, found ",
                 grid.size[0], " x ", grid.size[1], " x ", grid.size[2], " x ", layers,
                 " voxels in ", bytes, " bytes"));
}

}  // namespace mesamis::detail::label_files
