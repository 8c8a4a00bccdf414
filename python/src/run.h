// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mesamis/run/outcome_details.h"
#include "mesamis/run/run_files.h"
#include "volume.h"

/// What a call of segment() returns: a run with all that can be asked of it afterwards.
namespace mesamis::python {

struct Run {
  Outcome outcome;
  std::shared_ptr<Scan> scan;  ///< whose samples the outcome may refer to; none: labels alone
  Frame frame = Frame::kLps;
  int threads = 0;
  ReportFacts facts;
  double seconds = 0;

  const OutcomeDetails& details() const { return outcome.details(); }
  /// What the files of this run have in common.
  RunFiles files() const;
  /// What was warned of, but for the verdict; a line each.
  std::vector<std::string> warnings() const;
};

/// The region of a mesh file by its name. @throws InputError  for another name.
MeshOptions mesh_options(const std::string& region, int bins);

/// Text that is UTF-8, whatever bytes the names in files have.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace mesamis::python
