// SPDX-License-Identifier: Apache-2.0
#include "run_plan.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mesamis/base/error.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/method/memory.h"
#include "mesamis/object/places.h"
#include "mesamis/report/report.h"
#include "scan.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

using nlohmann::ordered_json;

constexpr double kBytesPerLabel = 2;      // of a map, for each voxel and layer
constexpr double kBytesOfFlow = 100;      // per voxel and layer, see find_labelled_objects()
constexpr double kBytesOfSmoothing = 60;  // per voxel, see surfaces_of_labels(), and surfaces
constexpr double kBytesOfProgram = 5e7;
constexpr double kBytesOfProbability = 4;  // for each voxel and object

struct Shares {
  double samples = 0, labels = 0, method = 0;  // bytes
};

/// Where the file is a map that read_grid() does not know, the scan's grid stands for it; without a
/// scan the labels are read.
VoxelGrid label_grid(const fs::path& path, const LabelOptions& how, const VoxelGrid* scan) {
  try {
    ReadOptions read;
    read.limits = how.limits;
    read.spacing = how.spacing;
    read.resample = how.resample;
    return read_any_grid(path, read);
  } catch (const InputError&) {
    if (!fs::exists(path)) throw;
    return scan != nullptr ? *scan : read_label_map(path, how).map;
  }
}

double voxels_of(const VoxelGrid& grid) { return static_cast<double>(grid.voxel_count()); }

double bytes_of_labels(const LabelArguments& labels, const VoxelGrid& grid) {
  const auto objects = static_cast<double>(labels.probabilities.size());
  return (kBytesPerLabel + kBytesOfProbability * objects) * voxels_of(grid);
}

fs::path label_path(const LabelArguments& labels) {
  return labels.file.empty() ? labels.probabilities.front() : labels.file;
}

Shares shares_of(const ScanArguments& arguments, Settings settings, bool mesh,
                 const VoxelGrid& grid) {
  Shares shares;
  const LabelArguments& labels = arguments.labels;
  if (labels.given() && !mesh) settings.preview = true;  // no cells
  if (!arguments.places.box.empty()) {
    settings.crop = box_to_range(grid, arguments.places.box, arguments.frame);
  }
  shares.samples = sizeof(float) * voxels_of(grid);
  shares.method = memory_needed(grid, settings);
  if (!labels.given()) return shares;
  shares.labels = bytes_of_labels(labels, label_grid(label_path(labels), labels.read, &grid));
  shares.method += kBytesOfFlow * voxels_of(grid);
  return shares;
}

}  // namespace

nlohmann::ordered_json run_plan(const ScanArguments& arguments, const Settings& settings,
                                bool mesh) {
  const bool alone = arguments.input.empty();
  const LabelArguments& labels = arguments.labels;
  const VoxelGrid grid = alone ? label_grid(label_path(labels), labels.read, nullptr)
                               : read_any_grid(arguments.input, arguments.read);
  const Shares shares = alone ? Shares{0, bytes_of_labels(labels, grid),
                                       kBytesOfProgram + kBytesOfSmoothing * voxels_of(grid)}
                              : shares_of(arguments, settings, mesh, grid);
  const auto whole = [](double bytes) { return static_cast<std::int64_t>(std::ceil(bytes)); };
  const Vec3& mm = grid.spacing;
  return {{"program", program_json()},
          {"input",
           {{"path", alone ? ordered_json(nullptr) : ordered_json(arguments.input.string())},
            {"size", grid.size},
            {"spacing_mm", {mm.x, mm.y, mm.z}}}},
          {"voxels", grid.voxel_count()},
          {"memory_bytes", whole(shares.samples) + whole(shares.labels) + whole(shares.method)},
          {"memory",
           {{"samples", whole(shares.samples)},
            {"labels", whole(shares.labels)},
            {"method", whole(shares.method)}}}};
}

}  // namespace mesamis
