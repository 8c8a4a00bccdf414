// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "body_options.h"
#include "chosen_scan.h"
#include "commands.h"
#include "mesamis/delivery/mesh_output.h"
#include "mesamis/method/settings.h"
#include "page_options.h"

namespace mesamis {

/// What a run of `segment` reads and writes, whether of one object or of several.
struct SegmentRun {
  ScanArguments scan;  ///< its input may be empty: the labels alone
  std::vector<std::filesystem::path> surfaces;
  std::vector<std::filesystem::path> meshes, band_meshes;
  MeshOptions mesh;  ///< of the meshes
  BodyArguments body;
  std::filesystem::path labelmap, report;  ///< may be empty
  /// Of the whole in the files; never the scan's, which may be the patient's.
  std::string name = "mesamis surface";
  bool error = false;  ///< write the error expected at each point
  nlohmann::ordered_json report_also = nlohmann::ordered_json::object();  ///< entries of the report
  /// Sees the report before the files appear; what it writes appears with them. May be empty.
  std::function<void(const nlohmann::ordered_json& report)> on_report;
  std::filesystem::path on_report_file;  ///< that it writes; may be empty
  PageArguments page;
  std::vector<std::string> command;  ///< the command line, for the report

  bool wants_report() const { return !report.empty() || on_report || page.given(); }
  bool wants_mesh() const { return !meshes.empty() || !band_meshes.empty(); }
};

/// Adds what a run says of its own to a report, writes it and shows it to on_report.
/// @throws InputError  as write_json().
void deliver_report(const SegmentRun& run, nlohmann::ordered_json& report);

/// Checks the name of a label map before any work.
/// @throws CLI::ValidationError, InputError  as require_output().
void require_labelmap(const std::filesystem::path& path, const std::string& option);

/// Finds the objects of a label map and writes them.
/// @return the exit status.
int run_labels(const SegmentRun& run, const Settings& settings, const CommonOptions& common);

/// Finds the parts that several seeds split an object into, and writes them as objects.
/// @return the exit status.
int run_parts(const SegmentRun& run, const Settings& settings, const ChosenScan& scan,
              const CommonOptions& common);

}  // namespace mesamis
