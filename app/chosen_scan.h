// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/files/dicom_subject.h"
#include "mesamis/method/chosen_run.h"
#include "mesamis/report/report.h"
#include "mesamis/volume_files/read_volume.h"
#include "place_options.h"

namespace mesamis {

/// What a run of `segment` reads, and which object of it is meant.
struct ScanArguments {
  std::filesystem::path input;
  ReadOptions read;
  PlaceArguments places;
  LabelArguments labels;
  Frame frame = Frame::kLps;
  bool report = false;   ///< whether the facts of the scan are needed
  bool patient = false;  ///< whether surfaces in DICOM belong to the patient and study of the scan
};

/// A scan that was read, and what is asked of it.
struct ReadScan {
  Volume volume;                        ///< native units
  ObjectRequest object;                 ///< which object is meant
  std::optional<InputFacts> facts;      ///< of the scan, if asked for
  std::vector<std::string> warnings{};  ///< of the readers of label files, one line each
  DicomSubject subject{};               ///< patient and study, if asked for
};

/// Reads the grid of the scan when it is called; empty without a scan. Refers to the arguments.
std::function<VoxelGrid()> grid_of_scan(const ScanArguments& arguments);

/// Reads a scan and the masks that choose an object of it.
/// @param memory_gb  limit of the run that follows, see require_memory(); nothing: not checked.
/// @throws InputError  as read_scan(), the readers of label maps and require_memory().
ReadScan read_chosen_scan(const ScanArguments& arguments, const Settings& settings,
                          const std::optional<double>& memory_gb);

}  // namespace mesamis
