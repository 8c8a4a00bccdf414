// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "mesamis/files/dicom_subject.h"
#include "mesamis/method/chosen_run.h"
#include "mesamis/record/report.h"
#include "mesamis/scan_files/read_volume.h"
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

/// The image of the object that is meant, and what is known of the scan it came from.
struct ChosenScan {
  VoxelGrid grid;                       ///< of the whole scan
  ChosenObject object;                  ///< the scan's samples are not kept beside it
  std::optional<InputFacts> facts;      ///< of the scan as it was read, if asked for
  nlohmann::ordered_json report;        ///< the report's entry "object"
  std::vector<std::string> warnings{};  ///< of the readers of label files, one line each
  DicomSubject subject{};               ///< patient and study, if asked for
};

/// Reads the grid of the scan when it is called; empty without a scan. Refers to the arguments.
std::function<VoxelGrid()> grid_of_scan(const ScanArguments& arguments);

/// Reads a scan and makes the image of the object that is meant; logs what was done unasked.
/// @param memory_gb  limit of the run that follows, see require_memory(); nothing: not checked.
/// @throws InputError  as read_scan(), choose_object() and require_memory().
ChosenScan read_chosen_scan(const ScanArguments& arguments, const Settings& settings,
                            const std::optional<double>& memory_gb);

}  // namespace mesamis
