// SPDX-License-Identifier: Apache-2.0
#include "segment_labels.h"

#include <algorithm>

#include "costs.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/delivery/label_output.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/record/body_json.h"
#include "mesamis/record/json_file.h"
#include "mesamis/record/label_report.h"
#include "mesamis/record/report.h"
#include "mesamis/shape_files/object_files.h"
#include "outputs.h"
#include "progress.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaceholder = "{label}";

bool holds_objects(const fs::path& path) {
  const auto formats = written_object_formats();
  return std::find(formats.begin(), formats.end(), lower_extension(path)) != formats.end();
}

/// Each object with a number of its own: its label, or where layers share labels a running one.
std::vector<NamedSurface> named_segments(const std::vector<Segment>& segments) {
  std::vector<NamedSurface> named;
  std::vector<Index> labels;
  labels.reserve(segments.size());
  for (const Segment& s : segments) labels.push_back(s.label);
  std::sort(labels.begin(), labels.end());
  const bool unique = std::adjacent_find(labels.begin(), labels.end()) == labels.end();
  for (const Segment& s : segments) {
    const Index label = unique ? s.label : static_cast<Index>(named.size()) + 1;
    named.push_back({s.name, s.colour, label, {}});
  }
  return named;
}

std::vector<NamedSurface> named_surfaces(const LabelResult& result) {
  std::vector<Segment> segments;
  segments.reserve(result.objects.size());
  for (const LabelledObject& object : result.objects) segments.push_back(object.segment);
  std::vector<NamedSurface> named = named_segments(segments);
  for (std::size_t n = 0; n < named.size(); ++n) named[n].surface = result.objects[n].surface;
  return named;
}

bool names_each(const fs::path& path) {
  return path.filename().string().find(kPlaceholder) != std::string::npos;
}

/// One file per object. The object's name stands where {label} is, or before the extension.
/// @param several  more than one object was asked for.
std::vector<fs::path> paths_of(const fs::path& path, const std::vector<NamedSurface>& objects,
                               bool several) {
  const std::string text = path.filename().string();
  const auto at = text.find(kPlaceholder);
  if (at == std::string::npos) {
    return several ? object_paths(path, objects) : std::vector<fs::path>{path};
  }
  // object_paths() makes "x-NAME.e" of "x.e": names safe for files, all different.
  const auto numbered = object_paths(fs::path("x" + path.extension().string()), objects);
  std::vector<fs::path> paths;
  for (const fs::path& one : numbered) {
    std::string file = text;
    const std::string name = one.stem().string().substr(2);
    paths.push_back(path.parent_path() / file.replace(at, std::string(kPlaceholder).size(), name));
  }
  return paths;
}

SurfaceWriteOptions write_options(const SegmentRun& run, const std::string& name) {
  SurfaceWriteOptions as;
  as.frame = run.scan.frame;
  as.name = name;
  as.metadata = {{"producer", producer()}};
  return as;
}

void write_each(const fs::path& path, const SegmentRun& run, const LabelResult& result,
                const std::vector<NamedSurface>& objects, bool several) {
  const auto paths = paths_of(path, objects, several);
  for (std::size_t n = 0; n < objects.size(); ++n) {
    SurfaceWriteOptions as = write_options(run, objects[n].name);
    const auto& expected = result.objects[n].expected_error;
    if (run.error && !expected.empty()) as.point_arrays.push_back({"expected_error", expected});
    write_surface(paths[n], objects[n].surface, as);
  }
}

void write_surfaces(const SegmentRun& run, const LabelResult& result, bool several) {
  const std::vector<NamedSurface> objects = named_surfaces(result);
  std::vector<NamedSurface> rounded;  // for files of one object each in single precision
  for (const fs::path& path : run.surfaces) {
    if (holds_objects(path) && !names_each(path)) {
      write_objects(path, objects, write_options(run, run.name));
    } else {
      const bool single = lower_extension(path) == ".stl";
      if (single && rounded.empty()) rounded = rounded_together(objects);
      write_each(path, run, result, single ? rounded : objects, several);
    }
  }
}

std::vector<FoundObject> found_objects(const LabelResult& result) {
  std::vector<FoundObject> found;
  for (const LabelledObject& object : result.objects) {
    found.push_back({object.surface, object.segment});
  }
  return found;
}

/// The mesh with the labels that the surfaces have in files.
MeshOutput mesh_output(const SegmentRun& run, const LabelResult& result, const Volume& scan) {
  const std::vector<NamedSurface> named = named_surfaces(result);
  std::vector<FoundObject> objects = found_objects(result);
  for (std::size_t n = 0; n < named.size(); ++n) objects[n].segment.label = named[n].label;
  return make_mesh_output(*result.mesh, scan, run.mesh, objects);
}

void write_report(const SegmentRun& run, const nlohmann::ordered_json& found,
                  const ChosenScan& scan, const OutputSet& set) {
  nlohmann::ordered_json report;
  report["program"] = program_json();
  if (scan.facts) report["input"] = input_json(*scan.facts);
  report["output"] = output_json(run.scan.frame);
  report.update(found);
  if (scan.facts) report["object"].update(scan.report);
  report["files"] = files_json(set);
  add_costs(report);
  write_json(run.report, report);
}

/// Tells what was asked for and not found.
/// @throws InputError  if that is all.
void require_found(const LabelResult& result, const std::vector<Segment>& wanted) {
  if (result.objects.empty()) {
    throw InputError("labels: expected a surface of at least one object, found none");
  }
  for (const Segment& s : wanted) {
    const bool found = std::any_of(result.objects.begin(), result.objects.end(),
                                   [&](const LabelledObject& o) { return o.segment == s; });
    if (!found) log_warning("labels: nothing was found of '" + s.name + "'");
  }
}

/// One body of all objects, if it was asked for.
std::optional<BodyOutput> make_body(const SegmentRun& run, const LabelResult& result,
                                    const ChosenScan& scan) {
  if (!run.body.given()) return {};
  const double tolerance = result.parameters.tolerance;
  return make_body_output(found_objects(result), scan.object.volume,
                          body_request(run.body, tolerance));
}

/// Writes what was found.
/// @param wanted  the objects that were asked for.
/// @return the exit status.
int deliver(const SegmentRun& run, const LabelResult& result, const ChosenScan& scan,
            const std::vector<Segment>& wanted) {
  require_found(result, wanted);
  std::vector<SurfaceCheck> checks;
  for (const LabelledObject& object : result.objects) {
    checks.push_back(check_surface(object.surface));
  }
  std::optional<MeshOutput> mesh;
  if (!run.meshes.empty()) mesh = mesh_output(run, result, scan.object.volume);
  const std::optional<BodyOutput> body = make_body(run, result, scan);
  OutputSet set;
  write_surfaces(run, result, wanted.size() > 1);
  if (body) write_bodies(run.body, *body, run.scan.frame);
  for (const fs::path& path : run.meshes) write_mesh(path, *mesh, run.scan.frame);
  for (const fs::path& path : run.band_meshes) write_band_mesh(path, *result.mesh, run.scan.frame);
  if (!run.labelmap.empty()) {
    write_label_map(run.labelmap, label_map_of(scan.grid, found_objects(result)));
  }
  if (!run.report.empty()) {
    auto found = label_run_json(result, checks);
    if (mesh) found["mesh"]["region"] = region_json(*mesh);
    if (body) found["body"] = body_json(*body);
    write_report(run, found, scan, set);
  }
  commit(set);
  const Verdict verdict = judge(result, checks);
  if (verdict.outcome != Outcome::kKept) log_error(verdict.message);
  return exit_status(verdict.outcome);
}

}  // namespace

void require_labelmap(const fs::path& path) {
  const bool packed = lower_extension(path) == ".gz" && lower_extension(path.stem()) == ".nii";
  require_output(path, {".nii", packed ? ".gz" : ".nii.gz", ".nrrd"}, "--labelmap");
}

namespace {

/// Where the error at each point is asked for, a file of one object each must have a place for it.
void require_error_place(const SegmentRun& run) {
  const auto holds = [](const fs::path& path) {
    return carries_arrays(path) && (names_each(path) || !holds_objects(path));
  };
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
    const bool together = holds_objects(path) && !names_each(path);
    const Paths files = together ? Paths{path} : paths_of(path, objects, wanted.size() > 1);
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
  const NamedLabels labels = read_labels(run.scan.labels);
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
  ProgressDisplay display(common.quiet);
  const LabelResult result =
      alone ? surfaces_of_labels(request, settings, display.callback())
            : run_on_labels(scan.object, request, settings, display.callback());
  display.finish();
  return deliver(run, result, scan, wanted);
}

int run_parts(const SegmentRun& run, const Settings& settings, const ChosenScan& scan,
              const CommonOptions& common) {
  require_error_place(run);
  require_object_files(run, scan.object.parts->segments);
  ProgressDisplay display(common.quiet);
  const LabelRequest parts{.map = *scan.object.parts, .mesh = run.wants_mesh()};
  const LabelResult result = run_on_labels(scan.object, parts, settings, display.callback());
  display.finish();
  return deliver(run, result, scan, scan.object.parts->segments);
}

}  // namespace mesamis
