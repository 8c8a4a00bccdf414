// SPDX-License-Identifier: Apache-2.0
// A DICOM series as a volume: which series (dicom_series), where its slices lie (dicom_spacing),
// and their samples (dicom_pixels).
#include <array>
#include <memory>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/dicom_phases.h"
#include "mesamis/volume_files/dicom_pixels.h"
#include "mesamis/volume_files/dicom_resample.h"
#include "mesamis/volume_files/dicom_series.h"
#include "mesamis/volume_files/dicom_spacing.h"
#include "mesamis/volume_files/dicom_store.h"
#include "mesamis/volume_files/formats.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

/// What decides how a series becomes a volume.
struct Reading {
  const ReadOptions& options;
  MemoryBudget& budget;
};

DicomImage image_in(const DicomStore& store, const fs::path& file, const Reading& reading) {
  const auto& [options, budget] = reading;
  const ScopedFile scope(budget, file);
  return describe_image(store.read(file), budget, options.spacing);
}

/// The images of a folder, or of that of a file, and the files that cannot be opened.
struct FolderImages {
  std::vector<DicomImage> images;
  std::vector<std::string> unreadable;  ///< each with its reason

  /// A line about what is left out, if anything is.
  void warn(std::vector<std::string>& warnings) const {
    if (unreadable.empty()) return;
    warnings.push_back(message(unreadable.size(), unreadable.size() == 1 ? " file" : " files",
                               " left out that cannot be read, the first ", unreadable[0]));
  }
};

FolderImages read_images(const DicomStore& store, const Reading& reading) {
  constexpr std::size_t kCopies = 4;  // as images, as series, sorted, and while these grow
  MemoryBudget& budget = reading.budget;
  FolderImages found{{}, store.unreadable()};
  for (const fs::path& file : store.files()) {
    DicomImage image = image_in(store, file, reading);
    budget.claim(kCopies * image.slices.size(), sizeof(DicomSlice) + file.native().size(),
                 "DICOM slices");
    append_within(budget, found.images, std::move(image), "DICOM images");
  }
  return found;
}

ScanFile grid_of(const fs::path& path, const DicomSeries& series, const SortedSlices& stack) {
  ScanFile scan{path, "DICOM", {}, {}, series.warnings};
  const DicomSlice& first = stack.slices.front();
  set_size(scan, {first.columns, first.rows, static_cast<std::int64_t>(stack.slices.size())});
  set_axes(scan, grid_steps(first, mean_spacing(stack) * stack.normal));
  set_origin(scan, first.position);
  scan.grid.modality = series.modality;
  scan.grid.frame_of_reference = series.frame_of_reference;
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
Stack plan(const fs::path& path, const DicomSeries& series, const ReadOptions& options) {
  if (!series.problem.empty()) throw InputError(series.problem);
  if (series.stacks[0].size() < 2) {
    const DicomSlice& only = series.stacks[0][0];
    refuse(only.file,
           "one slice is not a volume: expected at least 2 slices in the series, "
           "found 1");
  }
  PhaseChoice phase = choose_phase(path, series.stacks[0], {options.volume, options.channel});
  if (phase.stack.size() < 2) refuse(path, "expected at least 2 slices of each phase, found 1");
  Stack stack{sort_along_normal(std::move(phase.stack)), {}, {}};
  if (options.resample) {
    stack.resampling = plan_resampling(path, stack.sorted);
  } else {
    require_even_spacing(path, stack.sorted);
    require_no_tilt(path, stack.sorted);
  }
  stack.scan = grid_of(path, series, stack.sorted);
  if (!phase.note.empty()) stack.scan.warnings.push_back(phase.note);
  if (!stack.resampling.needed()) return stack;
  static_cast<VoxelGrid&>(stack.scan.grid) = stack.resampling.grid;
  stack.scan.grid.modality = series.modality;
  stack.scan.grid.frame_of_reference = series.frame_of_reference;
  for (const std::string& note : stack.resampling.notes) stack.scan.warnings.push_back(note);
  return stack;
}

/// A file that is decoded, as long as it is.
struct OpenFile {
  OpenFile(const DicomStore& store, const fs::path& path, MemoryBudget& budget)
      : scope(budget, path), file(store.read(path)), pixels(pixels_of(file)) {}

  ScopedFile scope;
  DicomFile file;
  DicomPixels pixels;
};

/// Decodes file by file, in the order of the slices. A file of many frames is read once as long as
/// its frames follow one another.
std::vector<float> decode(const DicomStore& store, const SortedSlices& stack, MemoryBudget& budget,
                          std::vector<std::string>& warnings) {
  const DicomSlice& first = stack.slices.front();
  const std::size_t voxels = static_cast<std::size_t>(first.columns) *
                             static_cast<std::size_t>(first.rows) * stack.slices.size();
  std::vector<float> samples;
  reserve_within(budget, samples, voxels, "samples");
  std::unique_ptr<OpenFile> open;
  std::vector<const DicomSlice*> damaged;
  for (const DicomSlice& slice : stack.slices) {
    if (open == nullptr || open->file.path != slice.file) {
      open.reset();
      open = std::make_unique<OpenFile>(store, slice.file, budget);
    }
    const auto& [scope, file, pixels] = *open;
    const FrameRescale rescale{slice.frame, slice.slope, slice.intercept};
    const ScopedClaim claim(budget, 1, decoding_bytes(file, pixels, slice.frame), "a frame");
    if (!append_frame(file, pixels, rescale, samples)) damaged.push_back(&slice);
  }
  if (!damaged.empty()) {
    warnings.push_back(message("corrupt JPEG data in ", damaged.size(), " slices, the first ",
                               name_of(*damaged[0]), ": decoded as far as they go"));
  }
  return samples;
}

VolumeInfo info_of(const fs::path& path, const DicomSeries& series, const ReadOptions& options) {
  VolumeInfo info{series.uid, series.description, "DICOM", series.modality, {}, {}, ""};
  try {
    const ScanFile scan = plan(path, series, options).scan;
    set_grid(info, scan.grid);
    info.warnings = scan.warnings;
  } catch (const InputError& error) {
    info.problem = error.what();
  }
  return info;
}

}  // namespace

bool looks_like_dicom(const fs::path& file) {
  std::array<unsigned char, 132> begin{};
  std::error_code error;
  if (fs::file_size(file, error) < 8 || error || !why_unreadable(file).empty()) return false;
  const std::size_t got = ByteSource(file, Packing::kPlain).read(begin.data(), begin.size());
  return begins_like_dicom(Bytes(begin).first(got));
}

VolumeFile read_dicom(const fs::path& path, const ReadOptions& options, MemoryBudget& budget) {
  const DicomStore store(path, budget);
  std::string wanted = options.series;
  if (!fs::is_directory(path) && !is_zip(path)) {
    const DicomImage named = image_in(store, path, {options, budget});
    if (!named.has_pixels) {
      refuse(path, "expected a DICOM image, found " + in_quotes(named.modality));
    }
    if (!named.problem.empty()) throw InputError(named.problem);
    if (wanted.empty()) wanted = named.series;
  }
  const FolderImages found = read_images(store, {options, budget});
  const std::vector<DicomSeries> all = group_by_series(found.images);
  const DicomSeries& series = choose_series(path, all, wanted);
  Stack stack = plan(path, series, options);
  ScanFile& scan = stack.scan;
  found.warn(scan.warnings);
  announce(scan.grid, options);
  if (wanted.empty() && all.size() > 1) {
    scan.warnings.push_back("taken as the only volume among the series " + titles_of(all));
  }
  VolumeFile out{std::move(scan.grid), "DICOM", scan.warnings};
  out.volume.samples = decode(store, stack.sorted, budget, out.warnings);
  if (stack.resampling.needed()) {
    const DicomSlice& first = stack.sorted.slices.front();
    budget.claim(out.volume.voxel_count(), sizeof(float), "samples between slices");
    out.volume.samples =
        resampled(stack.resampling, {first.columns, first.rows}, out.volume.samples);
  }
  return out;
}

std::vector<VolumeInfo> list_dicom(const fs::path& path, const ReadOptions& options,
                                   MemoryBudget& budget) {
  const DicomStore store(path, budget);
  std::vector<VolumeInfo> infos;
  const FolderImages found = read_images(store, {options, budget});
  for (const DicomSeries& series : group_by_series(found.images)) {
    infos.push_back(info_of(path, series, options));
    found.warn(infos.back().warnings);
  }
  return infos;
}

}  // namespace mesamis::detail::volume_files
