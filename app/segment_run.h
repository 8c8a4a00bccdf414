// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "body_options.h"
#include "chosen_scan.h"
#include "mesamis/run/run_files.h"
#include "segment_slabs.h"
#include "settings_options.h"

namespace mesamis {

/// Everything that a run of `segment` is asked for.
struct SegmentOptions {
  ScanArguments scan;  ///< its input may be empty: the labels alone
  SettingsArguments settings;
  BodyArguments body;
  RunFiles out;  ///< but for bodies, frame and facts, which follow from the others
  SlabArguments slabs;
  std::optional<double> time_limit;  ///< s, from wall_seconds() 0
  /// The options given that mean nothing without --mesh, without --output.
  std::vector<std::string> of_mesh, of_surfaces;
  bool plan = false;  ///< only tell what the run needs
  nlohmann::ordered_json report_also = nlohmann::ordered_json::object();  ///< entries of the report
  std::filesystem::path report_reader_file;  ///< that out.facts.written writes; may be empty

  bool wants_mesh() const { return !out.meshes.empty() || !out.band_meshes.empty(); }
};

/// Runs `segment`: for its own command line, and for those who ask for it in another way.
/// @return the exit status.
/// @throws CLI::ValidationError, InputError, NumericalError  as the command.
int run_segment(SegmentOptions options, const CommonOptions& common);

}  // namespace mesamis
