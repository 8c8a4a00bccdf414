// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/study_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mesamis/report/comparison_json.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/settings_json.h"

namespace mesamis::detail::study {
namespace {

using nlohmann::ordered_json;

ordered_json plan_json(const PlannedRun& plan) {
  return {{"name", plan.name}, {"s", plan.s}, {"stride", plan.stride}};
}

/// The figures of the tables, beside the report of the run.
ordered_json figures_json(const Volume& grid, const RunSummary& run) {
  const Iteration& last = run.iterations.back();
  return {{"size", grid.size},
          {"spacing_mm", vec_json(grid.spacing)},
          {"energy_mm3", run.energy_mm3()},
          {"adaptations", run.adaptations()},
          {"aspect_max", last.aspect_max[0]},
          {"aspect_mean", last.aspect_mean[0]},
          {"seconds", run.seconds.total}};
}

ordered_json compared_json(const RunComparison& comparison) {
  ordered_json json{{"triangles", comparison.triangles},
                    {"reference_triangles", comparison.reference_triangles},
                    {"triangle_reduction_percent", comparison.triangle_reduction_percent()}};
  if (comparison.variation_percent) {
    json["distance_variation_percent"] = *comparison.variation_percent;
  }
  return json;
}

ordered_json distances_entry(const RunComparison& comparison) {
  return {{"unit", "mm"},
          {"surface_to_reference", distances_json(comparison.surface_to_reference)},
          {"reference_to_surface", distances_json(comparison.reference_to_surface)},
          {"paper", paper_distances_json(comparison.distances)}};
}

ordered_json runs_json(const ExperimentRecord& experiment) {
  ordered_json runs = ordered_json::array();
  for (const StudyRun& run : experiment.runs) runs.push_back(run_json(experiment.settings, run));
  return runs;
}

}  // namespace

VerdictKind StudyRecord::outcome() const {
  VerdictKind worst = VerdictKind::kKept;
  for (const ExperimentRecord& experiment : experiments) {
    for (const StudyRun& run : experiment.runs) worst = std::max(worst, run.outcome);
  }
  return worst;
}

ordered_json run_json(const Settings& settings, const StudyRun& run) {
  ordered_json json = plan_json(run.plan);
  if (run.summary) {
    json.update(figures_json(run.grid, *run.summary));
    json.update(run_json(settings, *run.summary));
  }
  if (!run.surface_file.empty()) json["surface_file"] = run.surface_file;
  if (!run.failure.empty()) json["failed"] = run.failure;
  json["converged"] = run.converged();
  if (run.comparison) {
    json["compared"] = compared_json(*run.comparison);
    json["distances"] = distances_entry(*run.comparison);
  }
  json["remark"] = run.remark;
  return json;
}

ordered_json study_json(const StudyRecord& study) {
  ordered_json report;
  report["program"] = program_json();
  report["input"] = input_json(study.input);
  report["output"] = output_json(study.frame);
  report["reference"] = {{"path", study.reference.string()},
                         {"triangles", study.reference_triangles},
                         {"vertices", study.reference_vertices}};
  report["frames"] = study.frames ? frames_json(*study.frames) : nullptr;
  report["settings"] = to_json(study.settings);
  for (const ExperimentRecord& experiment : study.experiments) {
    report[experiment.name]["runs"] = runs_json(experiment);
  }
  report["pictures"] = study.pictures;
  report["converged"] = study.outcome() == VerdictKind::kKept;
  return report;
}

}  // namespace mesamis::detail::study
