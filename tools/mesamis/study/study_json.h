// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/report/report.h"
#include "mesamis/shape_files/surface_pair.h"
#include "mesamis/study/study_run.h"

/// A study as JSON, as docs/formats.md describes study.json.
namespace mesamis::detail::study {

/// The runs of one experiment.
struct ExperimentRecord {
  std::string name;   ///< "subsampling" or "region"
  Settings settings;  ///< of every run, see Experiment
  std::vector<StudyRun> runs;
};

/// A whole study.
struct StudyRecord {
  InputFacts input;           ///< the scan
  Frame frame = Frame::kLps;  ///< of the surfaces written
  std::filesystem::path reference;
  std::int64_t reference_triangles = 0, reference_vertices = 0;
  std::optional<SurfacePair> frames;  ///< its surfaces are not used; none: no run has a surface
  Settings settings;                  ///< of the study; those of an experiment may differ
  std::vector<ExperimentRecord> experiments;
  std::vector<std::string> pictures;  ///< names of the diagrams drawn

  /// The worst outcome of all runs.
  VerdictKind outcome() const;
};

/// The entry of one run. Figures that the run does not have are left out.
/// @param settings  of its experiment.
/// @throws InputError  if the comparison has no distance. O(n log n) for n distances.
nlohmann::ordered_json run_json(const Settings& settings, const StudyRun& run);

/// The whole report, but for the costs of the program, which the caller adds.
/// @throws InputError  as run_json(). Cost as there, for each run.
nlohmann::ordered_json study_json(const StudyRecord& study);

}  // namespace mesamis::detail::study
