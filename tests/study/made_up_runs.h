// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "mesamis/study/study_run.h"

namespace mesamis {

/// A run with three iterations, and distances of which each lies `distance` mm from the reference.
inline StudyRun made_up_run(const PlannedRun& plan, double distance) {
  StudyRun run;
  run.plan = plan;
  run.grid.size = {20, 21, 22};
  run.grid.spacing = {1, 1, 1.5};
  RunSummary summary;
  summary.parameters.unit_mm = 2;
  summary.iterations.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    Iteration& iteration = summary.iterations[i];
    iteration.tets = 1000 * (static_cast<std::int64_t>(i) + 1);
    iteration.nodes = iteration.tets / 5;
    iteration.energy.fidelity = 8 - 2.0 * static_cast<double>(i);
    iteration.energy_change = iteration.mesh_change = iteration.estimator = 0.25;
    iteration.aspect_max = {7, 5, 3};
    iteration.aspect_mean = {2.5, 2, 1};
  }
  summary.tets = 3000;
  summary.nodes = 600;
  summary.triangles = 30;
  summary.vertices = 17;
  summary.printable.triangles_extracted = 90;
  summary.converged = true;
  summary.parameters.tolerance = std::numeric_limits<double>::infinity();
  summary.seconds.total = 1.5;
  run.summary = summary;
  RunComparison comparison;
  comparison.triangles = 30;
  comparison.reference_triangles = 40;
  comparison.distances = {plan.name, {distance, distance}, {distance, distance, distance}};
  comparison.reference_to_surface = summarize(comparison.distances);
  comparison.surface_to_reference = comparison.reference_to_surface;
  run.comparison = comparison;
  return run;
}

/// The rows of a table, each a map from the names of the columns.
inline std::vector<std::map<std::string, std::string>> csv_rows(const std::string& csv) {
  std::istringstream text(csv);
  std::string line, cell;
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(text, line)) {
    std::istringstream cells(line + ",");
    std::vector<std::string> row;
    while (std::getline(cells, cell, ',')) row.push_back(cell);
    if (names.empty()) {
      names = row;
      continue;
    }
    auto& entry = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(row.size(), names.size()); ++i) entry[names[i]] = row[i];
  }
  return rows;
}

}  // namespace mesamis
