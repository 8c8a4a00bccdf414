// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/delivery/mesh_output.h"
#include "mesamis/method/chosen_run.h"
#include "mesamis/method/label_surfaces.h"
#include "volume.h"

/// What a call of segment() returns: a run with all that can be asked of it afterwards.
namespace mesamis::python {

/// What runs of either kind have in common.
struct RunFacts {
  std::shared_ptr<Scan> scan;  ///< none: labels alone
  std::optional<ChosenObject>
      object;         ///< its volume has no samples where the scan is read in place
  Settings settings;  ///< that were asked for
  Frame frame = Frame::kLps;
  int threads = 0;
  std::vector<std::string> notes, warnings;
  nlohmann::ordered_json input, chosen;  ///< the report's "input" and "object"
  double seconds = 0;
  std::string flaw;  ///< a promise that was not kept; empty: all were

  /// The image that the run was made of.
  VolumeView image() const;
  /// The beginning of a report.
  nlohmann::ordered_json report_head() const;
};

/// A run for one object.
struct Run : RunFacts {
  Result result;
  SurfaceCheck check;
};

/// A run for several.
struct LabelRun : RunFacts {
  LabelResult result;
  VoxelGrid grid;
  std::vector<SurfaceCheck> checks;
  std::size_t wanted = 0;  ///< objects that were asked for
};

/// The region of a mesh file by its name. @throws InputError  for another name.
MeshOptions mesh_options(const std::string& region, int bins);

/// What is wrong with the bytes of names in files. @throws InputError  unless it is UTF-8.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace mesamis::python
