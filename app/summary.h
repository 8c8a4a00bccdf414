// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/run/outcome_details.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// What came out of a run for one object.
struct ObjectFigures {
  std::string name;
  std::int64_t triangles = 0;
  SurfaceCheck check;                    ///< of its surface
  Vec3 size;                             ///< of the box around its surface, mm
  std::optional<double> expected_error;  ///< in the mean over its surface, mm
};

/// What came out of a run, for people.
struct RunFigures {
  std::vector<ObjectFigures> objects;
  std::int64_t shared = 0;      ///< triangles that two objects have
  std::optional<double> level;  ///< native units
  /// Of most places, native units; where these differ.
  std::optional<std::array<double, 2>> level_range{};
  std::string unit;                      ///< of the level
  Vec3 size;                             ///< of the box around all surfaces, mm
  std::optional<double> expected_error;  ///< in the mean over all surfaces, mm
  std::optional<double> largest_error;   ///< that 95 % of the one surface stay below, mm
  std::vector<std::filesystem::path> files;
};

/// The figures of a run, but for the files.
RunFigures figures_of(const OutcomeDetails& outcome);

/// Five lines: object; size and volume; triangles, level; expected error; files. Of several objects
/// a line for each in place of the first, twelve at most: those that are not closed, then the first
/// ones; a further line counts the others.
std::vector<std::string> summary_lines(const RunFigures& run);

/// Logs them.
void show_summary(const RunFigures& run);

}  // namespace mesamis
