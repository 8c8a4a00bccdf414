// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"
#include "label_options.h"
#include "mesamis/base/frame.h"
#include "mesamis/method/settings.h"
#include "mesamis/scan_files/read_volume.h"

namespace mesamis {

/// What a run of `segment` on labels reads and writes.
struct LabelRun {
  std::filesystem::path input;  ///< the scan; empty: the labels alone
  ReadOptions read;             ///< of the scan
  LabelArguments labels;
  std::vector<std::filesystem::path> surfaces;
  std::filesystem::path labelmap, report;  ///< may be empty
  std::string name;                        ///< of the whole in the files
  Frame frame = Frame::kLps;
  bool error = false;  ///< write the error expected at each point
  Settings settings;
};

/// Checks the name of a label map before any work.
/// @throws CLI::ValidationError, InputError  as require_output().
void require_labelmap(const std::filesystem::path& path);

/// Finds the objects of a label map and writes them.
/// @return the exit status.
int run_labels(const LabelRun& run, const CommonOptions& common);

}  // namespace mesamis
