// SPDX-License-Identifier: Apache-2.0
// A DICOM series as a volume: which series (dicom_series), where its slices lie (dicom_spacing),
// and their samples (dicom_pixels).
#include <array>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"
#include "mesamis/scan_files/dicom_pixels.h"
#include "mesamis/scan_files/dicom_resample.h"
#include "mesamis/scan_files/dicom_series.h"
#include "mesamis/scan_files/dicom_spacing.h"
#include "mesamis/scan_files/formats.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

std::vector<DicomImage> read_images(const fs::path& path) {
  const bool directory = fs::is_directory(path);
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<DicomImage> images;
  for (const fs::path& file : directory ? files_below(path) : files_in(parent)) {
    if (looks_like_dicom(file)) images.push_back(describe_image(read_dicom_file(file)));
  }
  return images;
}

ScanFile grid_of(const fs::path& path, const DicomSeries& series, const SortedSlices& stack) {
  ScanFile scan{path, "DICOM", {}, {}, series.warnings};
  const DicomSlice& first = stack.slices.front();
  set_size(scan, {first.columns, first.rows, static_cast<std::int64_t>(stack.slices.size())});
  set_axes(scan, grid_steps(first, mean_spacing(stack) * stack.normal));
  set_origin(scan, first.position);
  scan.grid.modality = series.modality;
  return scan;
}

/// A stack of slices, and the grid of the volume that comes of it.
struct Stack {
  SortedSlices sorted;
  ScanFile scan;
  ResamplePlan resampling;  ///< where the slices are not the grid's own
};

/// Everything but the samples.
/// @throws InputError  why the series is no volume.
Stack plan(const fs::path& path, const DicomSeries& series, bool resample) {
  if (!series.problem.empty()) throw InputError(series.problem);
  if (series.stacks[0].size() < 2) {
    const DicomSlice& only = series.stacks[0][0];
    refuse(only.file,
           "one slice is not a volume: expected at least 2 slices in the series, "
           "found 1");
  }
  Stack stack{sort_along_normal(series.stacks[0]), {}, {}};
  if (resample) {
    stack.resampling = plan_resampling(path, stack.sorted);
  } else {
    require_even_spacing(path, stack.sorted);
    require_no_tilt(path, stack.sorted);
  }
  stack.scan = grid_of(path, series, stack.sorted);
  if (!stack.resampling.needed()) return stack;
  static_cast<VoxelGrid&>(stack.scan.grid) = stack.resampling.grid;
  stack.scan.grid.modality = series.modality;
  for (const std::string& note : stack.resampling.notes) stack.scan.warnings.push_back(note);
  return stack;
}

/// Decodes file by file, in the order of the slices. A file of many frames is read once as long as
/// its frames follow one another.
std::vector<float> decode(const SortedSlices& stack, std::size_t voxels,
                          std::vector<std::string>& warnings) {
  std::vector<float> samples;
  samples.reserve(voxels);
  DicomFile file;
  DicomPixels pixels;
  std::vector<const DicomSlice*> damaged;
  for (const DicomSlice& slice : stack.slices) {
    if (file.path != slice.file) {
      file = {};
      file = read_dicom_file(slice.file);
      pixels = pixels_of(file);
    }
    const FrameRescale rescale{slice.frame, slice.slope, slice.intercept};
    if (!append_frame(file, pixels, rescale, samples)) damaged.push_back(&slice);
  }
  if (!damaged.empty()) {
    warnings.push_back(say("corrupt JPEG data in ", damaged.size(), " slices, the first ",
                           name_of(*damaged[0]), ": decoded as far as they go"));
  }
  return samples;
}

VolumeInfo info_of(const fs::path& path, const DicomSeries& series, bool resample) {
  VolumeInfo info{series.uid, series.description, "DICOM", series.modality, {}, {}, ""};
  try {
    set_grid(info, plan(path, series, resample).scan.grid);
  } catch (const InputError& error) {
    info.problem = error.what();
  }
  return info;
}

}  // namespace

bool looks_like_dicom(const fs::path& file) {
  std::array<unsigned char, 132> begin{};
  std::error_code error;
  if (fs::file_size(file, error) < 8 || error) return false;
  const std::size_t got = ByteSource(file, Packing::kPlain).read(begin.data(), begin.size());
  return begins_like_dicom(Bytes(begin).first(got));
}

VolumeFile read_dicom(const fs::path& path, const ReadOptions& options) {
  std::string wanted = options.series;
  const bool directory = fs::is_directory(path);
  if (!directory) {
    const DicomImage named = describe_image(read_dicom_file(path));
    if (!named.has_pixels) {
      refuse(path, "expected a DICOM image, found " + in_quotes(named.modality));
    }
    if (!named.problem.empty()) throw InputError(named.problem);
    if (wanted.empty()) wanted = named.series;
  }
  const std::vector<DicomSeries> all = group_by_series(read_images(path));
  const DicomSeries& series = choose_series(path, all, wanted);
  Stack stack = plan(path, series, options.resample);
  ScanFile& scan = stack.scan;
  if (wanted.empty() && all.size() > 1) {
    scan.warnings.push_back("taken as the only volume among the series " + titles_of(all));
  }
  VolumeFile out{std::move(scan.grid), "DICOM", scan.warnings};
  const DicomSlice& first = stack.sorted.slices.front();
  const std::size_t stored = static_cast<std::size_t>(first.columns) *
                             static_cast<std::size_t>(first.rows) * stack.sorted.slices.size();
  out.volume.samples = decode(stack.sorted, stored, out.warnings);
  if (stack.resampling.needed()) {
    out.volume.samples =
        resampled(stack.resampling, {first.columns, first.rows}, out.volume.samples);
  }
  return out;
}

std::vector<VolumeInfo> list_dicom(const fs::path& path, const ReadOptions& options) {
  std::vector<VolumeInfo> infos;
  for (const DicomSeries& series : group_by_series(read_images(path)))
    infos.push_back(info_of(path, series, options.resample));
  return infos;
}

}  // namespace mesamis::detail
