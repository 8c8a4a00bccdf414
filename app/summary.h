// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/run/outcome_details.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// What came out of a run, for people at a terminal.
struct RunFigures {
  std::string object;                    ///< what was meant
  std::optional<double> level;           ///< native units
  std::string unit;                      ///< of the level
  std::vector<const TriMesh*> surfaces;  ///< mm
  std::vector<SurfaceCheck> checks;      ///< of the surfaces
  std::optional<double> expected_error;  ///< in the mean, mm
  std::vector<std::filesystem::path> files;
};

/// The figures of a run, but for the files; refer to the outcome.
RunFigures figures_of(const OutcomeDetails& outcome);

/// Five lines: object; level and expected error; size; triangles, parts, closed or not; files.
std::vector<std::string> summary_lines(const RunFigures& run);

/// Shows them where stderr is a terminal whose lines are for people, and nowhere else.
void show_summary(const RunFigures& run);

}  // namespace mesamis
