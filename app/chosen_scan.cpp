// SPDX-License-Identifier: Apache-2.0
#include "chosen_scan.h"

#include <utility>

#include "mesamis/method/memory.h"
#include "mesamis/object/places.h"
#include "scan.h"

namespace mesamis {
namespace {

/// Before the samples are read: they are held too.
void require_memory_for(const VoxelGrid& grid, const CropRange& crop, Settings settings,
                        double memory_gb) {
  settings.crop = crop;
  require_memory(grid, settings, memory_gb,
                 sizeof(float) * static_cast<double>(grid.voxel_count()));
}

}  // namespace

std::function<VoxelGrid()> grid_of_scan(const ScanArguments& arguments) {
  if (arguments.input.empty()) return {};
  return [&arguments] { return read_any_grid(arguments.input, arguments.read); };
}

ReadScan read_chosen_scan(const ScanArguments& arguments, const Settings& settings,
                          const std::optional<double>& memory_gb) {
  ReadRequest asked = read_request(
      {arguments.places, arguments.labels, arguments.frame, grid_of_scan(arguments)}, settings);
  ReadScan scan;
  scan.object = std::move(asked.object);
  scan.warnings = std::move(asked.warnings);
  ReadOptions read = arguments.read;
  read.on_grid = [&](const VoxelGrid& grid) {
    if (!arguments.places.box.empty()) {
      scan.object.crop = box_to_range(grid, arguments.places.box, arguments.frame);
    }
    if (memory_gb) require_memory_for(grid, scan.object.crop, settings, *memory_gb);
  };
  VolumeFile file = read_scan(arguments.input, read);
  if (arguments.patient) scan.subject = read_dicom_subject(file.files, arguments.read.limits);
  if (arguments.report) {
    scan.facts = facts_of({arguments.input, file.format, file.warnings, file.files}, file.volume);
  }
  scan.volume = std::move(file.volume);
  return scan;
}

}  // namespace mesamis
