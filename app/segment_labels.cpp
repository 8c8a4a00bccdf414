// SPDX-License-Identifier: Apache-2.0
#include "segment_labels.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/delivery/label_output.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/record/body_json.h"
#include "mesamis/record/json_file.h"
#include "mesamis/record/label_report.h"
#include "mesamis/record/label_surface_files.h"
#include "mesamis/record/meshing_json.h"
#include "mesamis/record/report.h"
#include "outputs.h"
#include "progress.h"
#include "run_record.h"
#include "summary.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

/// The mesh with the labels that the surfaces have in files.
MeshOutput mesh_output(const SegmentRun& run, const LabelResult& result, const Volume& scan) {
  const std::vector<NamedSurface> named = named_surfaces(result);
  std::vector<FoundObject> objects = found_objects(result);
  for (std::size_t n = 0; n < named.size(); ++n) objects[n].segment.label = named[n].label;
  return make_mesh_output(*result.mesh, scan, run.mesh, objects);
}

/// Of the objects; refers to the result.
RunRecord record_of(const LabelResult& result, nlohmann::ordered_json found,
                    std::span<const SurfaceCheck> checks) {
  RunRecord record;
  record.found = std::move(found);
  record.verdict = judge(result, checks);
  for (const LabelledObject& object : result.objects) {
    record.surfaces.push_back({&object.surface, object.segment.name, object.segment.colour});
  }
  if (result.mesh) {
    record.mesh = &result.mesh->mesh;
    record.grey = result.mesh->u;
  }
  return record;
}

void show_objects(const LabelResult& result, std::vector<SurfaceCheck> checks, const Paths& files) {
  RunFigures figures;
  for (const LabelledObject& object : result.objects) {
    figures.object += (figures.object.empty() ? "" : ", ") + object.segment.name;
    figures.surfaces.push_back(&object.surface);
  }
  figures.checks = std::move(checks);
  figures.files = files;
  show_summary(figures);
}

/// Makes the elements that are asked for, one mesh for all objects. The surfaces become theirs
/// where they are to suit other meshers.
ElementResults fill_surfaces(const SegmentRun& run, LabelResult& result, const ChosenScan& scan,
                             const RunContext& how) {
  const Volume& volume = scan.object.volume;
  const VoxelGrid& grid = run.scan.input.empty() ? scan.grid : volume;
  const std::vector<FoundObject> objects = found_objects(result);
  ElementResults elements =
      make_elements(run.body, {objects, grid, volume, run.scan.frame, result.parameters.blur}, how);
  for (std::size_t n = 0; n < elements.surfaces.size(); ++n) {
    LabelledObject& object = result.objects[n];
    take_surface(std::move(elements.surfaces[n]), object.surface, object.expected_error);
  }
  return elements;
}

/// Writes what was found.
/// @param wanted  the objects that were asked for.
/// @return the exit status.
int deliver(const SegmentRun& run, LabelResult& result, const ChosenScan& scan,
            const std::vector<Segment>& wanted, const RunContext& how) {
  for (const std::string& line : missing_objects(result, wanted)) log_warning(line);
  const ElementResults elements = fill_surfaces(run, result, scan, how);
  how.display.finish();
  std::vector<SurfaceCheck> checks;
  for (const LabelledObject& object : result.objects) {
    checks.push_back(check_surface(object.surface));
  }
  std::optional<MeshOutput> mesh;
  if (!run.meshes.empty()) mesh = mesh_output(run, result, scan.object.volume);
  OutputSet set;
  write_label_surfaces(run.surfaces, result,
                       {run.scan.frame, run.name, run.error, false, scan.subject},
                       wanted.size() > 1);
  if (elements.body) write_bodies(run.body, *elements.body, run.scan.frame);
  for (const fs::path& path : run.meshes) write_mesh(path, *mesh, run.scan.frame);
  for (const fs::path& path : run.band_meshes) write_band_mesh(path, *result.mesh, run.scan.frame);
  if (!run.labelmap.empty()) {
    write_label_map(run.labelmap, label_map_of(scan.grid, found_objects(result)));
  }
  if (run.wants_report()) {
    auto found = label_run_json(result, checks);
    if (mesh) found["mesh"]["region"] = region_json(*mesh);
    if (elements.body) found["body"] = body_json(*elements.body);
    for (std::size_t n = 0; n < elements.quality.size(); ++n) {
      found["object"]["surfaces"][n]["meshing"] = meshing_json(elements.quality[n]);
    }
    write_record(run, scan, record_of(result, std::move(found), checks), set);
  }
  const Paths files = files_of(set);
  commit(set);
  show_objects(result, checks, files);
  const Verdict verdict = judge(result, checks);
  if (verdict.outcome != Outcome::kKept) log_error(verdict.message);
  return status_with(elements, exit_status(verdict.outcome));
}

}  // namespace

void deliver_report(const SegmentRun& run, nlohmann::ordered_json& report) {
  report.update(run.report_also);
  if (!run.report.empty()) write_json(run.report, report);
  if (run.on_report) run.on_report(report);
}

void require_labelmap(const fs::path& path, const std::string& option) {
  const bool packed = lower_extension(path) == ".gz" && lower_extension(path.stem()) == ".nii";
  require_output(path, {".nii", packed ? ".gz" : ".nii.gz", ".nrrd"}, option);
}

namespace {

/// Where the error at each point is asked for, a file of one object each must have a place for it.
void require_error_place(const SegmentRun& run) {
  const auto holds = [](const fs::path& path) { return carries_arrays(path) && !holds_all(path); };
  if (run.error && std::none_of(run.surfaces.begin(), run.surfaces.end(), holds)) {
    throw CLI::ValidationError(
        "--error", "expected a .ply, or a .vtp with {label} in its name, for several objects");
  }
  if (run.error && run.scan.input.empty()) {
    throw CLI::ValidationError("--error", "expected a scan beside the labels, found none");
  }
}

/// A mesh is made of the scan.
void require_scan_for_mesh(const SegmentRun& run) {
  if (run.wants_mesh() && run.scan.input.empty()) {
    throw CLI::ValidationError("--mesh", "expected a scan beside the labels, found none");
  }
  if (run.body.given() && run.scan.input.empty()) {
    throw CLI::ValidationError("--body", "expected a scan beside the labels, found none");
  }
}

/// The files of objects, whose names are known with the labels, can be written.
void require_object_files(const SegmentRun& run, const std::vector<Segment>& wanted) {
  const std::vector<NamedSurface> objects = named_segments(wanted);
  Paths all;
  for (const fs::path& path : run.surfaces) {
    const bool together = holds_all(path);
    const Paths files = together ? Paths{path} : label_paths(path, objects, wanted.size() > 1);
    all.insert(all.end(), files.begin(), files.end());
    if (together && lower_extension(path) == ".obj") {
      all.push_back(fs::path(path).replace_extension(".mtl"));
    }
  }
  for (const fs::path& path : all) require_writable(path);
  require_distinct_files(all, {});
}

/// A NIfTI file has one layer.
void require_layers(const SegmentRun& run, const std::vector<Segment>& wanted) {
  if (run.labelmap.empty() || lower_extension(run.labelmap) == ".nrrd") return;
  for (const Segment& s : wanted) {
    if (s.layer != wanted.front().layer) {
      throw InputError("--labelmap: expected a .nrrd or .seg.nrrd, as '" + s.name +
                       "' may overlap others, found " + run.labelmap.string());
    }
  }
}

}  // namespace

int run_labels(const SegmentRun& run, const Settings& settings, const CommonOptions& common) {
  require_error_place(run);
  require_scan_for_mesh(run);
  const NamedLabels labels = read_labels(run.scan.labels, grid_of_scan(run.scan));
  LabelRequest request = label_request(run.scan.labels, labels);
  request.mesh = run.wants_mesh();
  const std::vector<Segment>& wanted =
      request.chosen.empty() ? labels.map.segments : request.chosen;
  require_layers(run, wanted);
  require_object_files(run, wanted);
  const bool alone = run.scan.input.empty();
  ChosenScan scan;
  if (alone) {
    scan.grid = labels.map;
  } else {
    scan = read_chosen_scan(run.scan, settings, {});
  }
  scan.warnings.insert(scan.warnings.end(), labels.warnings.begin(), labels.warnings.end());
  ProgressDisplay display(common.quiet);
  LabelResult result = alone ? surfaces_of_labels(request, settings, display.callback())
                             : run_on_labels(scan.object, request, settings, display.callback());
  return deliver(run, result, scan, wanted, {settings, common, display});
}

int run_parts(const SegmentRun& run, const Settings& settings, const ChosenScan& scan,
              const CommonOptions& common) {
  require_error_place(run);
  require_object_files(run, scan.object.parts->segments);
  ProgressDisplay display(common.quiet);
  const LabelRequest parts{.map = *scan.object.parts, .mesh = run.wants_mesh()};
  LabelResult result = run_on_labels(scan.object, parts, settings, display.callback());
  return deliver(run, result, scan, scan.object.parts->segments, {settings, common, display});
}

}  // namespace mesamis
