// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/study_run.h"

#include <algorithm>

#include "mesamis/base/error.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/study/part_inside.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::study {
namespace {

void mark_failed(StudyRun& run, const std::string& reason) {
  run.outcome = VerdictKind::kNotConverged;
  run.remark = run.failure = reason;
  run.surface = {};
}

std::int64_t triangle_count(const TriMesh& surface) {
  return static_cast<std::int64_t>(surface.triangles.size());
}

/// The mean distance (15) of the paper, mm.
double mean_distance(const RunComparison& comparison) {
  return comparison.reference_to_surface.vertices.mean;
}

/// The mean distance of the baseline; 0 if there is none.
double baseline_mean(const std::vector<StudyRun>& runs) {
  const auto baseline = std::find_if(runs.begin(), runs.end(), [](const StudyRun& run) {
    return run.plan.baseline && run.comparison;
  });
  return baseline == runs.end() ? 0 : mean_distance(*baseline->comparison);
}

}  // namespace

double RunComparison::triangle_reduction_percent() const {
  const auto share = static_cast<double>(triangles) / static_cast<double>(reference_triangles);
  return 100 * (1 - share);
}

StudyRun segment_planned(const Experiment& experiment, const PlannedRun& plan,
                         const Progress& progress) {
  StudyRun run;
  run.plan = plan;
  run.grid = subsample(experiment.volume, plan.stride);
  Result result = mes_amis(run.grid, experiment.settings, progress);
  run.grid.samples = {};
  if (result.surface.triangles.empty()) {
    throw InputError("there is no surface: no node of the mesh lies beyond the level");
  }
  const SurfaceCheck check = check_surface(result.surface);
  Verdict verdict = judge(result, check);
  run.outcome = verdict.kind;
  run.remark = std::move(verdict.message);
  run.summary = summarize(result, check);
  run.surface = std::move(result.surface);
  return run;
}

StudyRun failed_run(const PlannedRun& plan, const std::string& reason) {
  StudyRun run;
  run.plan = plan;
  mark_failed(run, reason);
  return run;
}

void require_inside(const TriMesh& reference, const Experiment& experiment) {
  const Volume& volume = experiment.volume;
  if (!part_inside(reference, volume, volume.spacing).triangles.empty()) return;
  throw InputError(
      "expected triangles inside the " + std::string(experiment.cropped ? "region" : "scan") +
      ", a voxel away from its faces, found none of " + std::to_string(reference.triangles.size()));
}

StudyRun with_comparison(const TriMesh& reference, const Experiment& experiment, StudyRun run) {
  if (run.surface.triangles.empty()) return run;
  const auto measured_part = [&](const TriMesh& surface) {
    return experiment.cropped ? part_inside(surface, run.grid, experiment.volume.spacing) : surface;
  };
  const TriMesh surface = without_unused_points(run.surface);
  const TriMesh surface_part = measured_part(surface), reference_part = measured_part(reference);
  if (surface_part.triangles.empty() || reference_part.triangles.empty()) {
    mark_failed(run, "no triangle lies inside the region");
    return run;
  }
  RunComparison comparison;
  comparison.triangles = triangle_count(surface_part);
  comparison.reference_triangles = triangle_count(reference_part);
  comparison.distances = measure_distances(run.plan.name, reference_part, surface);
  comparison.reference_to_surface = summarize(comparison.distances);
  comparison.surface_to_reference =
      summarize(measure_distances(run.plan.name, surface_part, reference));
  run.comparison = std::move(comparison);
  return run;
}

std::vector<StudyRun> with_distance_variations(std::vector<StudyRun> runs) {
  const double reference = baseline_mean(runs);
  if (reference == 0) return runs;
  for (StudyRun& run : runs) {
    if (run.plan.baseline || !run.comparison) continue;
    const double mean = mean_distance(*run.comparison);
    run.comparison->variation_percent = 100 * (mean - reference) / reference;
  }
  return runs;
}

}  // namespace mesamis::detail::study
