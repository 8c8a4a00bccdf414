// SPDX-License-Identifier: Apache-2.0
#include "study.h"

#include <algorithm>

#include "commands.h"
#include "json_file.h"
#include "mesamis/base/error.h"
#include "mesamis/mes_amis.h"
#include "mesamis/surface/unused_points.h"
#include "report.h"
#include "verdict.h"

namespace mesamis {
namespace {

using nlohmann::ordered_json;

constexpr int kInPlane = 2;  // of the paper: 102 x 122 of 204 x 244 pixels

/// Looks before hours of work whether every run can begin.
void require_usable_runs(const Experiment& experiment) {
  for (const PlannedRun& plan : experiment.runs) {
    try {
      require_usable(subsample(experiment.volume, plan.stride));
    } catch (const InputError& error) {
      throw InputError(plan.name + ": " + error.what());
    }
  }
}

/// The figures of the tables, beside the report of the run.
ordered_json summary_json(const Volume& volume, const Result& result) {
  const Iteration& last = result.iterations.back();
  const double unit = result.unit_mm;
  return {{"size", volume.size},
          {"spacing_mm", vec_json(volume.spacing)},
          {"energy_mm3", last.energy.total() * unit * unit * unit},
          {"adaptations", result.iterations.size() - 1},
          {"aspect_max", last.aspect_max[0]},
          {"aspect_mean", last.aspect_mean[0]},
          {"seconds", result.seconds.total}};
}

}  // namespace

Experiment subsampling_experiment(const Volume& scan, const Settings& settings,
                                  const std::vector<int>& s) {
  const bool cut = settings.crop != CropRange{};
  Experiment experiment{"subsampling", "",       cut ? crop(scan, settings.crop) : scan,
                        cut,           settings, {}};
  experiment.settings.crop = {};
  for (const int every : s) {
    experiment.runs.push_back({"s" + std::to_string(every), every, {1, 1, every}});
  }
  require_usable_runs(experiment);
  return experiment;
}

Experiment region_experiment(const Volume& scan, const CropRange& region, const Settings& settings,
                             const std::vector<int>& s) {
  Experiment experiment{"region", "region_", crop(scan, region), true, settings, {}};
  experiment.settings.crop = {};
  experiment.settings.stride = {1, 1, 1};
  experiment.runs.push_back({"region_full", 1, {1, 1, 1}});
  for (const int every : s) {
    experiment.runs.push_back(
        {"region_s" + std::to_string(every), every, {kInPlane, kInPlane, every}});
  }
  require_usable_runs(experiment);
  return experiment;
}

StudyRun begun(const PlannedRun& plan) {
  StudyRun run;
  run.plan = plan;
  run.json = {{"name", plan.name}, {"s", plan.s}, {"stride", plan.stride}};
  return run;
}

TriMesh part_inside(const TriMesh& surface, const Volume& volume, const Vec3& margin) {
  const Box box{margin, volume.box().hi - margin};
  std::vector<bool> inside(surface.points.size());
  for (std::size_t i = 0; i < inside.size(); ++i) {
    inside[i] = box.contains(volume.to_grid(surface.points[i]));
  }
  TriMesh part{surface.points, {}};
  for (const Triangle& t : surface.triangles) {
    const auto is_inside = [&inside](Index p) { return inside[static_cast<std::size_t>(p)]; };
    if (std::all_of(t.begin(), t.end(), is_inside)) part.triangles.push_back(t);
  }
  return without_unused_points(part);
}

StudyRun execute(const Experiment& experiment, const PlannedRun& plan, const Progress& progress) {
  StudyRun run = begun(plan);
  run.grid = subsample(experiment.volume, plan.stride);
  Result result = mes_amis(run.grid, experiment.settings, progress);
  const SurfaceCheck check = check_surface(result.surface);
  const Verdict verdict = judge(result, check);
  run.status = verdict.status;
  run.remark = verdict.message;
  run.json.update(summary_json(run.grid, result));
  run.json.update(run_json(experiment.settings, result, check));
  run.surface = std::move(result.surface);
  run.grid.samples = {};
  if (run.surface.triangles.empty()) {
    throw InputError("there is no surface: no node of the mesh lies beyond the level");
  }
  return run;
}

void mark_failed(StudyRun& run, const std::string& why) {
  run.status = kExitNotConverged;
  run.remark = why;
  run.surface = {};
  run.json["failed"] = why;
  run.json["converged"] = false;
}

void compare_with(const TriMesh& reference, const Experiment& experiment, StudyRun& run) {
  if (run.surface.triangles.empty()) return;
  const auto part = [&](const TriMesh& surface) {
    return experiment.cut ? part_inside(surface, run.grid, experiment.volume.spacing) : surface;
  };
  const TriMesh whole = without_unused_points(run.surface);
  const TriMesh mine = part(whole), its = part(reference);
  if (mine.triangles.empty() || its.triangles.empty()) {
    return mark_failed(run, "no triangle lies inside the region");
  }
  run.reference_to_surface = measure(run.plan.name, its, whole);
  const Direction back = measure(run.plan.name, mine, reference);
  const auto share =
      static_cast<double>(mine.triangles.size()) / static_cast<double>(its.triangles.size());
  run.json["compared"] = {{"triangles", mine.triangles.size()},
                          {"reference_triangles", its.triangles.size()},
                          {"triangle_reduction_percent", 100 * (1 - share)}};
  run.json["distances"] = {{"unit", "mm"},
                           {"surface_to_reference", direction_json(back)},
                           {"reference_to_surface", direction_json(run.reference_to_surface)},
                           {"paper", paper_json(run.reference_to_surface)}};
}

void add_variations(std::vector<StudyRun>& runs) {
  const ordered_json::json_pointer mean("/distances/paper/average_hausdorff");
  if (runs.empty() || !runs[0].json.contains(mean)) return;
  const auto full = runs[0].json[mean].get<double>();
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (!runs[i].json.contains(mean) || full == 0) continue;
    const auto own = runs[i].json[mean].get<double>();
    runs[i].json["compared"]["distance_variation_percent"] = 100 * (own - full) / full;
  }
}

}  // namespace mesamis
