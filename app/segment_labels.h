// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "body_options.h"
#include "chosen_scan.h"
#include "commands.h"
#include "mesamis/delivery/mesh_output.h"
#include "mesamis/method/settings.h"

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

  bool wants_mesh() const { return !meshes.empty() || !band_meshes.empty(); }
};

/// Checks the name of a label map before any work.
/// @throws CLI::ValidationError, InputError  as require_output().
void require_labelmap(const std::filesystem::path& path);

/// Finds the objects of a label map and writes them.
/// @return the exit status.
int run_labels(const SegmentRun& run, const Settings& settings, const CommonOptions& common);

/// Finds the parts that several seeds split an object into, and writes them as objects.
/// @return the exit status.
int run_parts(const SegmentRun& run, const Settings& settings, const ChosenScan& scan,
              const CommonOptions& common);

}  // namespace mesamis
