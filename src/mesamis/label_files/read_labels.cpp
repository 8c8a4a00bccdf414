// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/read_labels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/refuse.h"
#include "mesamis/label_files/dicom_seg.h"
#include "mesamis/label_files/label_values.h"
#include "mesamis/label_files/nifti_labels.h"
#include "mesamis/label_files/nrrd_segments.h"
#include "mesamis/scan_files/formats.h"
#include "mesamis/scan_files/read_volume.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using detail::MemoryBudget;
using detail::refuse;
using detail::say;
using detail::ScanFile;

/// A file, and what it is read with.
struct Request {
  fs::path path;
  const ReadLimits& limits;
  MemoryBudget& budget;

  detail::Opening opening() const { return {budget, limits.allow_outside, detail::Values::kMany}; }
  ReadOptions options() const {
    ReadOptions all;
    all.limits = limits;
    return all;
  }
  /// Makes room for what samples become, of so many bytes each.
  void claim(const ScanFile& scan, std::uint64_t bytes, const char* what) const {
    const std::uint64_t values =
        static_cast<std::uint64_t>(scan.inner) * static_cast<std::uint64_t>(scan.outer);
    budget.claim(values * scan.grid.voxel_count(), bytes, what);
  }
};

detail::LayerOrder order_of(const ScanFile& scan) {
  return {static_cast<std::size_t>(scan.inner), static_cast<std::size_t>(scan.outer)};
}

/// The segments that an array file names. Broken names of a NIfTI file are a warning: its labels
/// are well.
std::vector<Segment> named_segments(const Request& request, const ScanFile& scan,
                                    std::vector<std::string>& warnings) {
  const auto& [path, limits, budget] = request;
  const auto layers = static_cast<std::size_t>(scan.inner) * static_cast<std::size_t>(scan.outer);
  if (scan.format == "NRRD") return detail::segments_in_keys(path, scan.keys, layers);
  if (scan.format != "NIfTI") return {};
  try {
    return detail::segments_in_extensions(path, detail::nifti_extensions(path, budget), budget);
  } catch (const InputError& error) {
    warnings.push_back(say("the names of the labels are not read: ", error.what()));
    return {};
  }
}

LabelFile labels_of_array(const Request& request, const ScanFile& scan) {
  const fs::path& path = request.path;
  if (scan.format != "NRRD" && scan.outer > 1) {
    refuse(path, say("expected one label per voxel, found ", scan.outer, " volumes"));
  }
  LabelFile out{{scan.grid, {}, {}}, scan.format, scan.warnings};
  out.map.segments = named_segments(request, scan, out.warnings);
  const std::vector<float> samples = detail::read_samples(scan, request.budget);
  request.claim(scan, sizeof(std::uint16_t), "labels");
  out.map.layers = detail::label_layers(path, scan.grid, order_of(scan), samples);
  out.map = with_all_segments(std::move(out.map));
  return out;
}

LabelFile labels_of_volume(const Request& request) {
  const fs::path& path = request.path;
  const VolumeFile file = read_volume(path, request.options());
  LabelFile out{{file.volume, {}, {}}, file.format, file.warnings};
  out.map.layers = detail::label_layers(path, file.volume, {}, file.volume.samples);
  out.map = with_all_segments(std::move(out.map));
  return out;
}

/// The path itself, or the only DICOM file of a directory.
fs::path file_of(const fs::path& path) {
  if (!fs::is_directory(path)) return path;
  std::vector<fs::path> files = detail::files_in(path);
  std::erase_if(files, [](const fs::path& file) { return !detail::looks_like_dicom(file); });
  if (files.size() != 1) {
    refuse(path, say("expected one DICOM segmentation in the directory, found ", files.size(),
                     " DICOM files"));
  }
  return files[0];
}

LabelFile read_map(const Request& request) {
  const fs::path& file = request.path;
  if (const auto scan = detail::open_array(file, request.opening())) {
    return labels_of_array(request, *scan);
  }
  if (detail::looks_like_dicom(file)) return detail::read_dicom_labels(file, request.budget);
  return labels_of_volume(request);
}

// --- Probabilities -----------------------------------------------------------------------------

/// Segment n of layer n with the label n + 1, as far as they have no name.
std::vector<Segment> numbered_segments(std::size_t count) {
  std::vector<Segment> segments;
  for (std::size_t n = 0; n < count; ++n) {
    const auto label = static_cast<Index>(n + 1);
    segments.push_back({say("label ", label), label, static_cast<Index>(n), default_colour(label)});
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

ProbabilityFile probabilities_of_file(const Request& request) {
  const fs::path& file = request.path;
  const auto scan = detail::open_array(file, request.opening());
  if (!scan) {
    if (detail::looks_like_dicom(file)) {
      return detail::read_dicom_probabilities(file, request.budget);
    }
    const VolumeFile volume = read_volume(file, request.options());
    return {
        {volume.volume, detail::probability_layers(file, volume.volume, {}, volume.volume.samples),
         numbered_segments(1)},
        volume.warnings};
  }
  ProbabilityFile out{{scan->grid, {}, {}}, scan->warnings};
  const auto names = named_segments(request, *scan, out.warnings);
  const std::vector<float> samples = detail::read_samples(*scan, request.budget);
  request.claim(*scan, sizeof(float), "probabilities");
  out.probabilities.layers = detail::probability_layers(file, scan->grid, order_of(*scan), samples);
  out.probabilities.segments = numbered_segments(out.probabilities.layers.size());
  take_names(out.probabilities.segments, names, scan->format == "NRRD");
  return out;
}

/// The largest distance of corresponding corners of two grids of one size, in voxels.
double shift_between(const VoxelGrid& a, const VoxelGrid& b) {
  double shift = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 pa, pb;
    for (int axis = 0; axis < 3; ++axis) {
      const double steps = (corner >> axis & 1) ? a.size[static_cast<std::size_t>(axis)] - 1 : 0;
      pa[axis] = steps * a.spacing[axis];
      pb[axis] = steps * b.spacing[axis];
    }
    shift = std::max(shift, norm(a.to_world(pa) - b.to_world(pb)));
  }
  return shift / a.shortest_side();
}

void require_same_grid(const fs::path& path, const VoxelGrid& found, const VoxelGrid& expected) {
  constexpr double kMostShift = 1e-3;
  const auto text = [](const std::array<Index, 3>& n) {
    return say(n[0], " x ", n[1], " x ", n[2], " voxels");
  };
  if (found.size != expected.size) {
    refuse(path, say("expected the grid of the first file, ", text(expected.size), ", found ",
                     text(found.size)));
  }
  const double shift = shift_between(expected, found);
  if (!(shift <= kMostShift)) {
    refuse(path,
           say("expected the grid of the first file, found one that lies ", shift, " voxels away"));
  }
}

std::string name_of(const fs::path& path) {
  const fs::path stem = path.stem();
  return (stem.extension() == ".nii" ? stem.stem() : stem).string();
}

/// The claims for one file are given back when it is read; what stays of it is claimed again.
ProbabilityFile read_one(const fs::path& path, const ReadLimits& limits, MemoryBudget& budget) {
  return detail::in_one_line(path, [&] {
    const detail::ScopedFile scope(budget, path);
    return probabilities_of_file({file_of(path), limits, budget});
  });
}

void append_volume(ProbabilityFile& all, const fs::path& path, const ReadLimits& limits,
                   MemoryBudget& budget) {
  ProbabilityFile one = read_one(path, limits, budget);
  budget.claim(one.probabilities.layers.size() * one.probabilities.voxel_count(), sizeof(float),
               "probabilities");
  Probabilities& to = all.probabilities;
  if (one.probabilities.layers.size() != 1) {
    refuse(path, say("expected one volume in each of several files, found ",
                     one.probabilities.layers.size()));
  }
  if (to.layers.empty()) static_cast<VoxelGrid&>(to) = one.probabilities;
  require_same_grid(path, one.probabilities, to);
  to.layers.push_back(std::move(one.probabilities.layers[0]));
  all.warnings.insert(all.warnings.end(), one.warnings.begin(), one.warnings.end());
}

}  // namespace

LabelFile read_label_map(const fs::path& path, const ReadLimits& limits) {
  MemoryBudget budget(path, limits);
  return detail::in_one_line(path, [&] { return read_map({file_of(path), limits, budget}); });
}

ProbabilityFile read_probabilities(const std::vector<fs::path>& paths, const ReadLimits& limits) {
  if (paths.empty()) throw InputError("probabilities: expected at least one file, found none");
  MemoryBudget budget(paths[0], limits);
  if (paths.size() == 1) return read_one(paths[0], limits, budget);
  ProbabilityFile all;
  for (const fs::path& path : paths) append_volume(all, path, limits, budget);
  all.probabilities.segments = numbered_segments(paths.size());
  for (std::size_t n = 0; n < paths.size(); ++n) {
    all.probabilities.segments[n].name = name_of(paths[n]);
  }
  return all;
}

}  // namespace mesamis
