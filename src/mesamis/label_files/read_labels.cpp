// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/read_labels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/given_spacing.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/refuse.h"
#include "mesamis/label_files/chunk_labels.h"
#include "mesamis/label_files/contour_labels.h"
#include "mesamis/label_files/dicom_seg.h"
#include "mesamis/label_files/label_values.h"
#include "mesamis/label_files/mask_folder.h"
#include "mesamis/label_files/nifti_labels.h"
#include "mesamis/label_files/nrrd_segments.h"
#include "mesamis/label_files/seg_file.h"
#include "mesamis/volume_files/chunked_scan.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/read_volume.h"
#include "mesamis/volume_files/sheared_grid.h"
#include "mesamis/volume_files/slice_stack.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

/// A file, and what it is read with.
struct Request {
  fs::path path;
  const LabelOptions& how;
  MemoryBudget& budget;

  Request at(const fs::path& other) const { return {other, how, budget}; }
  Opening opening() const {
    return {budget, how.limits.allow_outside, Values::kMany, how.spacing, how.resample};
  }
  ReadOptions options() const {
    ReadOptions all;
    all.limits = how.limits;
    all.spacing = how.spacing;
    return all;
  }
  /// Makes room for what samples become, of so many bytes each.
  void claim(const ScanFile& scan, std::uint64_t bytes, const char* what) const {
    const std::uint64_t values =
        static_cast<std::uint64_t>(scan.inner) * static_cast<std::uint64_t>(scan.outer);
    budget.claim(values * scan.grid.voxel_count(), bytes, what);
  }
};

LayerOrder order_of(const ScanFile& scan) {
  return {static_cast<std::size_t>(scan.inner), static_cast<std::size_t>(scan.outer)};
}

/// The segments that an array file names. Broken names of a NIfTI file are a warning: its labels
/// are well.
std::vector<Segment> named_segments(const Request& request, const ScanFile& scan,
                                    std::vector<std::string>& warnings) {
  const auto& [path, how, budget] = request;
  const auto layers = static_cast<std::size_t>(scan.inner) * static_cast<std::size_t>(scan.outer);
  if (scan.format == "NRRD") return segments_in_keys(path, scan.keys, layers);
  if (scan.format != "NIfTI") return {};
  try {
    return segments_in_extensions(path, nifti_extensions(path, budget), budget);
  } catch (const InputError& error) {
    warnings.push_back(message("the names of the labels are not read: ", error.what()));
    return {};
  }
}

/// Brings the layers of a sheared grid onto an orthogonal one.
/// @param map   of labels, or probabilities.
/// @param note  of the plan, for these.
template <class Map>
void unshear(const Request& request, const ScanFile& scan, Map& map, std::string ShearPlan::*note,
             std::vector<std::string>& warnings) {
  if (!scan.sheared) return;
  const ShearPlan plan = plan_unsheared(request.path, scan.grid, *scan.sheared);
  for (auto& layer : map.layers) {
    request.budget.claim(plan.grid.voxel_count(), sizeof layer[0], "a resampled layer");
    layer = unsheared(plan, layer);
  }
  static_cast<VoxelGrid&>(map) = plan.grid;
  warnings.push_back(plan.*note);
}

LabelFile labels_of_array(const Request& request, const ScanFile& scan) {
  const fs::path& path = request.path;
  if (scan.format != "NRRD" && scan.outer > 1) {
    refuse(path, message("expected one label per voxel, found ", scan.outer, " volumes"));
  }
  LabelFile out{{scan.grid, {}, {}}, scan.format, scan.warnings};
  out.map.segments = named_segments(request, scan, out.warnings);
  LabelBuilder builder(path, scan.grid, order_of(scan), request.budget);
  visit_samples(scan, [&](std::span<const double> samples) { builder.add(samples); });
  out.map = builder.finish(std::move(out.map), out.warnings);
  unshear(request, scan, out.map, &ShearPlan::label_note, out.warnings);
  return out;
}

/// Pictures state no place: that of a scan of as many voxels is theirs.
void take_place_of_scan(const Request& request, LabelFile& file) {
  if (!request.how.scan) return;
  const VoxelGrid scan = request.how.scan();
  if (scan.size != file.map.size) return;
  static_cast<VoxelGrid&>(file.map) = scan;
  file.warnings = {
      "the pictures state no place: they have as many voxels as the scan, and its "
      "place is taken"};
}

/// A volume of samples in single precision.
LabelFile labels_of_volume(const Request& request) {
  const fs::path& path = request.path;
  const VolumeFile file = read_volume(path, request.options());
  LabelFile out{{file.volume, {}, {}}, file.format, file.warnings};
  LabelBuilder builder(path, file.volume, {}, request.budget);
  builder.add(file.volume.samples);
  out.map = builder.finish(std::move(out.map), out.warnings);
  return out;
}

/// The colours of labels that are the indices of a table of them.
void take_colours(const ScanFile& scan, LabelMap& map) {
  for (Segment& segment : map.segments) {
    const auto number = static_cast<std::size_t>(number_of(segment));
    if (number < scan.palette.size()) segment.colour = scan.palette[number];
  }
}

/// A picture, or the slices of a folder.
LabelFile labels_of_pictures(const Request& request, const std::vector<fs::path>& files) {
  Opening opening = request.opening();
  opening.labels = true;
  const ScanFile scan = files.front() == request.path
                            ? open_picture(request.path, opening)
                            : open_stack(request.path, files, opening).scan;
  LabelFile out{{scan.grid, {}, {}}, scan.format, scan.warnings};
  LabelBuilder builder(request.path, scan.grid, {}, request.budget);
  for (const fs::path& file : files) {
    visit_picture(file, opening, [&](std::span<const double> samples) { builder.add(samples); });
  }
  out.map = builder.finish(std::move(out.map), out.warnings);
  take_colours(scan, out.map);
  take_place_of_scan(request, out);
  return out;
}

/// Whether the file is a DICOM segmentation or a structure set.
bool holds_labels(const fs::path& file, MemoryBudget& budget) {
  const ScopedFile scope(budget, file);
  const auto dicom = read_dicom_file(file, budget);
  return is_seg(dicom) || is_structure_set(dicom);
}

/// The DICOM files of a folder that hold labels.
struct DicomFolder {
  std::size_t files = 0;
  std::vector<fs::path> labels;
};

DicomFolder dicom_in(const fs::path& folder, MemoryBudget& budget) {
  DicomFolder found;
  for (const fs::path& file : files_in(folder)) {
    if (!looks_like_dicom(file)) continue;
    ++found.files;
    if (holds_labels(file, budget)) found.labels.push_back(file);
  }
  return found;
}

/// Whether a directory and those below it have DICOM files, all of which can be read and hold
/// labels.
bool holds_labels_alone(const fs::path& folder, const ReadLimits& limits) {
  MemoryBudget budget(folder, limits);
  bool any = false;
  try {
    for (const fs::path& file : files_below(folder)) {
      if (!looks_like_dicom(file)) continue;
      if (!holds_labels(file, budget)) return false;
      any = true;
    }
  } catch (const InputError&) {
    return false;  // the reader says what is wrong with it
  }
  return any;
}

[[noreturn]] void refuse_several(const fs::path& folder, const std::vector<fs::path>& files) {
  constexpr std::size_t kMostNamed = 4;
  std::string text;
  for (std::size_t n = 0; n < std::min(files.size(), kMostNamed); ++n) {
    text += (n > 0 ? ", " : "") + shown(files[n].filename().string());
  }
  refuse(folder,
         message("expected one DICOM segmentation or structure set in the directory, found ",
                 files.size(), ": ", text, files.size() > kMostNamed ? ", ..." : "",
                 "; name one of them"));
}

LabelFile read_map(const Request& request);

/// The grid of a header; none for pictures, which state no place.
std::optional<VoxelGrid> stated_grid(const Request& request, const fs::path& file) {
  const auto scan = open_array(file, request.opening());
  if (!scan) return std::nullopt;
  return scan->sheared ? plan_unsheared(file, scan->grid, *scan->sheared).grid
                       : static_cast<const VoxelGrid&>(scan->grid);
}

LabelFile read_folder(const Request& request) {
  const auto& [folder, how, budget] = request;
  const DicomFolder dicom = dicom_in(folder, budget);
  if (dicom.labels.size() > 1) refuse_several(folder, dicom.labels);
  if (dicom.labels.size() == 1) return read_map(request.at(dicom.labels[0]));
  const std::vector<fs::path> masks = masks_in(folder, budget);
  if (!masks.empty()) {
    const MaskReader reader{[&](const fs::path& file) { return read_map(request.at(file)); },
                            [&](const fs::path& file) { return stated_grid(request, file); }};
    return read_masks(masks, reader, budget);
  }
  const std::vector<fs::path> slices = slices_in(folder, budget);
  if (dicom.files == 0 && !slices.empty()) return labels_of_pictures(request, slices);
  refuse(folder,
         message("expected masks, slices of labels or one DICOM segmentation or structure set "
                 "in the directory, found ",
                 dicom.files > 0 ? message(dicom.files, " DICOM files of other kinds")
                                 : contents_of(folder)));
}

LabelFile labels_of_dicom(const Request& request) {
  {
    const ScopedFile scope(request.budget, request.path);
    const auto file = read_dicom_file(request.path, request.budget);
    if (is_structure_set(file)) {
      return read_contour_labels(file, request.how.scan, request.budget);
    }
  }
  return read_dicom_labels(request.path, request.budget);
}

LabelFile read_map(const Request& request) {
  const fs::path& path = request.path;
  if (is_zarr(path) || is_hdf5(path)) return read_chunk_labels(path, request.how.limits);
  if (fs::is_directory(path)) return read_folder(request);
  if (const auto scan = open_array(path, request.opening())) {
    return labels_of_array(request, *scan);
  }
  if (is_picture(path)) return labels_of_pictures(request, {path});
  if (!looks_like_dicom(path)) return labels_of_volume(request);
  return labels_of_dicom(request);
}

// --- Probabilities -----------------------------------------------------------------------------

/// Segment n of layer n with the label n + 1, as far as they have no name.
std::vector<Segment> numbered_segments(std::size_t count) {
  std::vector<Segment> segments;
  for (std::size_t n = 0; n < count; ++n) {
    const auto label = static_cast<Index>(n + 1);
    segments.push_back(
        {message("label ", label), label, static_cast<Index>(n), default_colour(label)});
  }
  return segments;
}

/// Names by the layer (NRRD) or the label (NIfTI) that the file states.
void take_names(std::vector<Segment>& segments, const std::vector<Segment>& named, bool by_layer) {
  for (const Segment& name : named) {
    const auto n = static_cast<std::size_t>(by_layer ? name.layer : name.label - 1);
    if (n >= segments.size()) continue;
    segments[n].name = name.name;
    segments[n].colour = name.colour;
  }
}

/// Whether the channels add up to 1 in every voxel, as those of a network with a softmax do.
bool add_up_to_one(const std::vector<std::vector<float>>& channels) {
  constexpr double kSlack = 0.01;  // half precision rounds
  if (channels.size() < 2) return false;
  const double most = parallel_max(channels[0].size(), 0, [&](std::size_t begin, std::size_t end) {
    double largest = 0;
    for (std::size_t n = begin; n < end; ++n) {
      double sum = -1;
      for (const auto& channel : channels) sum += channel[n];
      largest = std::max(largest, std::abs(sum));
    }
    return largest;
  });
  return most <= kSlack;
}

/// Leaves out the background, which comes first where the channels are those of a network: of such
/// that add up to 1 and do not all have names.
void leave_out_background(std::size_t named, ProbabilityFile& file) {
  auto& channels = file.probabilities.layers;
  if (named >= channels.size() || !add_up_to_one(channels)) return;
  file.warnings.push_back(message("the first of ", channels.size(),
                                  " channels, which add up to 1, is taken for the background; a "
                                  "file per object takes each for one"));
  channels.erase(channels.begin());
}

ProbabilityFile probabilities_of_file(const Request& request) {
  const fs::path& file = request.path;
  const auto scan = open_array(file, request.opening());
  if (!scan) {
    if (looks_like_dicom(file)) {
      return read_dicom_probabilities(file, request.budget);
    }
    const VolumeFile volume = read_volume(file, request.options());
    return {{volume.volume, probability_layers(file, volume.volume, {}, volume.volume.samples),
             numbered_segments(1)},
            volume.warnings};
  }
  ProbabilityFile out{{scan->grid, {}, {}}, scan->warnings};
  const auto names = named_segments(request, *scan, out.warnings);
  const std::vector<float> samples = read_samples(*scan, request.budget);
  request.claim(*scan, sizeof(float), "probabilities");
  out.probabilities.layers = probability_layers(file, scan->grid, order_of(*scan), samples);
  leave_out_background(names.size(), out);
  unshear(request, *scan, out.probabilities, &ShearPlan::note, out.warnings);
  out.probabilities.segments = numbered_segments(out.probabilities.layers.size());
  take_names(out.probabilities.segments, names, scan->format == "NRRD");
  return out;
}

/// The path itself, or the only DICOM file of a directory.
fs::path file_of(const fs::path& path) {
  if (!fs::is_directory(path)) return path;
  std::vector<fs::path> files = files_in(path);
  std::erase_if(files, [](const fs::path& file) { return !looks_like_dicom(file); });
  if (files.size() != 1) {
    refuse(path, message("expected one DICOM segmentation in the directory, found ", files.size(),
                         " DICOM files"));
  }
  return files[0];
}

/// The claims for one file are given back when it is read; what stays of it is claimed again.
ProbabilityFile read_one(const fs::path& path, const LabelOptions& how, MemoryBudget& budget) {
  return in_one_line(path, [&] {
    const ScopedFile scope(budget, path);
    ProbabilityFile file = probabilities_of_file({file_of(path), how, budget});
    apply_spacing(how.spacing, file.probabilities, file.warnings);
    return file;
  });
}

/// @param first  the file of the grid.
void append_volume(ProbabilityFile& all, const fs::path& path, const fs::path& first,
                   MemoryBudget& budget, const LabelOptions& how) {
  ProbabilityFile one = read_one(path, how, budget);
  budget.claim(one.probabilities.layers.size() * one.probabilities.voxel_count(), sizeof(float),
               "probabilities");
  Probabilities& to = all.probabilities;
  if (one.probabilities.layers.size() != 1) {
    refuse(path, message("expected one volume in each of several files, found ",
                         one.probabilities.layers.size()));
  }
  if (to.layers.empty()) static_cast<VoxelGrid&>(to) = one.probabilities;
  require_same_grid(path, one.probabilities, first, to);
  to.layers.push_back(std::move(one.probabilities.layers[0]));
  all.warnings.insert(all.warnings.end(), one.warnings.begin(), one.warnings.end());
}

}  // namespace

LabelFile read_label_map(const fs::path& path, const LabelOptions& options) {
  MemoryBudget budget(path, options.limits);
  return in_one_line(path, [&] {
    if (options.spacing) require_positive_spacing(path, *options.spacing);
    LabelFile file = read_map({path, options, budget});
    apply_spacing(options.spacing, file.map, file.warnings);
    return file;
  });
}

bool is_label_file(const fs::path& path, const ReadLimits& limits) {
  std::error_code error;
  if (is_zarr(path)) return holds_chunk_labels(path, limits);
  if (fs::is_directory(path, error)) return holds_labels_alone(path, limits);
  if (!fs::is_regular_file(path, error)) return false;
  if (lower(path.filename().string()).ends_with(".seg.nrrd")) return true;
  if (is_array_file(path) || is_picture(path) || !looks_like_dicom(path)) {
    return false;
  }
  MemoryBudget budget(path, limits);
  return holds_labels(path, budget);
}

bool is_mask_folder(const fs::path& path, const ReadLimits& limits) {
  std::error_code error;
  if (is_zarr(path)) return has_labels_inside(path);
  if (!fs::is_directory(path, error)) return false;
  MemoryBudget budget(path, limits);
  const std::vector<fs::path> files = files_below(path);
  return std::none_of(files.begin(), files.end(), looks_like_dicom) &&
         !masks_in(path, budget).empty();
}

ProbabilityFile read_probabilities(const std::vector<fs::path>& paths,
                                   const LabelOptions& options) {
  if (paths.empty()) throw InputError("probabilities: expected at least one file, found none");
  if (options.spacing) require_positive_spacing(paths[0], *options.spacing);
  MemoryBudget budget(paths[0], options.limits);
  if (paths.size() == 1) return read_one(paths[0], options, budget);
  ProbabilityFile all;
  for (const fs::path& path : paths) append_volume(all, path, paths[0], budget, options);
  all.probabilities.segments = numbered_segments(paths.size());
  for (std::size_t n = 0; n < paths.size(); ++n) {
    all.probabilities.segments[n].name = object_name(paths[n]);
  }
  return all;
}

}  // namespace mesamis
