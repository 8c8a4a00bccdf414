// SPDX-License-Identifier: Apache-2.0
#include "chosen_scan.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "log.h"
#include "mesamis/method/memory.h"
#include "mesamis/object/places.h"
#include "mesamis/record/object_report.h"
#include "scan.h"

namespace mesamis {
namespace {

nlohmann::ordered_json report_of(const ScanArguments& arguments, const ObjectRequest& request,
                                 const ChosenObject& object) {
  nlohmann::ordered_json report = object_json(request, object);
  if (request.mask) report["mask"]["path"] = arguments.places.mask.string();
  return report;
}

/// Before the samples are read: they are held too.
void require_memory_for(const VoxelGrid& grid, const CropRange& crop, Settings settings,
                        double memory_gb) {
  settings.crop = crop;
  require_memory(grid, settings, memory_gb,
                 sizeof(float) * static_cast<double>(grid.voxel_count()));
}

/// The files of a DICOM series.
DicomSubject subject_of(const VolumeFile& file, const ReadLimits& limits) {
  std::vector<std::filesystem::path> files;
  for (const ReadFile& read : file.files) files.push_back(read.path);
  return read_dicom_subject(files, limits);
}

}  // namespace

std::function<VoxelGrid()> grid_of_scan(const ScanArguments& arguments) {
  if (arguments.input.empty()) return {};
  return [&arguments] { return read_any_grid(arguments.input, arguments.read); };
}

ChosenScan read_chosen_scan(const ScanArguments& arguments, const Settings& settings,
                            const std::optional<double>& memory_gb) {
  ReadRequest asked = read_request(
      {arguments.places, arguments.labels, arguments.frame, grid_of_scan(arguments)}, settings);
  ObjectRequest& request = asked.object;
  ReadOptions read = arguments.read;
  read.on_grid = [&](const VoxelGrid& grid) {
    if (!arguments.places.box.empty()) {
      request.crop = box_to_range(grid, arguments.places.box, arguments.frame);
    }
    if (memory_gb) require_memory_for(grid, request.crop, settings, *memory_gb);
  };
  VolumeFile file = read_scan(arguments.input, read);
  ChosenScan scan;
  scan.grid = file.volume;
  scan.warnings = std::move(asked.warnings);
  if (arguments.patient) scan.subject = subject_of(file, arguments.read.limits);
  if (arguments.report) {
    scan.facts = facts_of({arguments.input, file.format, file.warnings, file.files}, file.volume);
  }
  scan.object = choose_object(std::move(file.volume), request);
  for (const std::string& note : scan.object.notes) log_info(note);
  for (const std::string& warning : scan.object.warnings) log_warning(warning);
  scan.report = report_of(arguments, request, scan.object);
  return scan;
}

}  // namespace mesamis
