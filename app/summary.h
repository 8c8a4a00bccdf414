// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/run/outcome.h"
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

/// The figures of a run that has found one object, but for the object's name and the files.
/// @param result, check  must live as long as the figures are shown; check is of the surface.
/// @param modality       of the scan, see VoxelGrid.
RunFigures figures_of(const Result& result, const SurfaceCheck& check, const std::string& modality);

/// The figures of a run that does not work in slabs, but for the files; refer to the outcome.
RunFigures figures_of(const Outcome& outcome);

/// Five lines: object; level and expected error; size; triangles, parts, closed or not; files.
std::vector<std::string> summary_lines(const RunFigures& run);

/// Shows them where stderr is a terminal whose lines are for people, and nowhere else.
void show_summary(const RunFigures& run);

}  // namespace mesamis
