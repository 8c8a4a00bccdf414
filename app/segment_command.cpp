// SPDX-License-Identifier: Apache-2.0
// mesamis segment: a scan in, a surface, an adapted mesh and a report out.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "chosen_scan.h"
#include "commands.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/delivery/label_output.h"
#include "mesamis/delivery/mesh_output.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/record/body_json.h"
#include "mesamis/record/meshing_json.h"
#include "mesamis/record/report.h"
#include "mesamis/record/run_surface.h"
#include "mesamis/record/verdict.h"
#include "mesamis/shape_files/surface_files.h"
#include "outputs.h"
#include "place_options.h"
#include "process.h"
#include "progress.h"
#include "run_plan.h"
#include "run_record.h"
#include "scan.h"
#include "segment_labels.h"
#include "segment_run.h"
#include "settings_options.h"
#include "summary.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

/// Options of the files alone, as --frame: no setting of the run depends on them.
void add_mesh_options(CLI::App& c, const std::shared_ptr<SegmentOptions>& o) {
  c.add_option("--mesh", o->meshes,
               "Adapted mesh: .vtu, Medit .mesh and .sol, Gmsh .msh, Abaqus and CalculiX .inp");
  c.add_option_function<std::string>(
       "--mesh-region",
       [o](const std::string& name) {
         o->mesh.region = name == "object" ? MeshRegion::kObject : MeshRegion::kBox;
       },
       "Cells of --mesh: box, all (default); object, those with more than half of their volume "
       "inside the level set of u, whole")
      ->check(CLI::IsMember({"box", "object"}));
  c.add_option("--bins", o->mesh.bins,
               "Sets of cells of --mesh, by equal ranges of their native value (default 10)")
      ->check(CLI::Range(1, kMostBins));
  c.add_option("--band-mesh", o->band_meshes, "The band's cells with v: .vtu");
}

SurfaceWriteOptions surface_options_for(const SegmentOptions& options, const Result& result,
                                        const ChosenScan& scan) {
  const bool grey = std::any_of(options.surfaces.begin(), options.surfaces.end(), carries_grey);
  return surface_options(result, scan.object.volume.voxel_size(),
                         {options.scan.frame, options.name, options.error, grey, scan.subject});
}

/// A run whose result nobody would see is not started.
void require_some_output(const SegmentOptions& options) {
  if (!options.surfaces.empty() || !options.meshes.empty() || !options.band_meshes.empty() ||
      !options.labelmap.empty() || options.wants_report() || options.body.given()) {
    return;
  }
  throw CLI::ValidationError(
      "segment",
      "expected --output, --mesh, --body, --band-mesh, --labelmap, --report, --html or --pictures, "
      "found nothing to write");
}

/// A Medit mesh has its fields in a file of their own.
fs::path fields_beside(const fs::path& mesh) { return fs::path(mesh).replace_extension(".sol"); }

Paths outputs_of(const SegmentOptions& options) {
  Paths outputs = page_outputs(options.page);
  outputs.insert(outputs.end(), {options.labelmap, options.report, options.on_report_file});
  for (const auto* paths :
       {&options.surfaces, &options.meshes, &options.band_meshes, &options.body.files}) {
    outputs.insert(outputs.end(), paths->begin(), paths->end());
  }
  for (const fs::path& mesh : options.meshes) {
    if (lower_extension(mesh) == ".mesh") outputs.push_back(fields_beside(mesh));
  }
  return outputs;
}

Paths inputs_of(const SegmentOptions& options) {
  const ScanArguments& scan = options.scan;
  Paths inputs{scan.input,       scan.labels.file,   scan.labels.names,
               scan.places.mask, scan.places.remove, options.settings.file};
  const Paths& more = scan.labels.probabilities;
  inputs.insert(inputs.end(), more.begin(), more.end());
  return inputs;
}

/// Only surfaces in DICOM have a place for a patient.
void require_patient(const SegmentOptions& options) {
  if (!options.scan.patient) return;
  const auto is_dicom = [](const fs::path& path) { return lower_extension(path) == ".dcm"; };
  if (std::none_of(options.surfaces.begin(), options.surfaces.end(), is_dicom)) {
    throw CLI::ValidationError("--patient", "expected a .dcm among --output, found none");
  }
  if (options.scan.input.empty() || options.slabs.given()) {
    throw CLI::ValidationError("--patient",
                               "expected a DICOM scan and no --slabs, found " +
                                   std::string(options.slabs.given() ? "--slabs" : "no scan"));
  }
}

void require_outputs(const SegmentOptions& options) {
  require_some_output(options);
  require_utf8(options.name, "--name");
  for (const fs::path& path : options.surfaces) {
    require_output(path, written_surface_formats(), "--output");
  }
  if (options.error &&
      std::none_of(options.surfaces.begin(), options.surfaces.end(), carries_arrays)) {
    throw CLI::ValidationError("--error", "expected a .vtp or .ply among --output, found none");
  }
  require_patient(options);
  std::vector<std::string> mesh_formats = written_mesh_formats();
  if (options.slabs.given()) mesh_formats.emplace_back(kPiecesExtension);
  for (const fs::path& path : options.meshes) require_output(path, mesh_formats, "--mesh");
  for (const fs::path& path : options.meshes) {
    if (lower_extension(path) == ".mesh") require_writable(fields_beside(path));
  }
  for (const fs::path& path : options.band_meshes) require_output(path, {".vtu"}, "--band-mesh");
  require_body(options.body);
  if (options.body.meshing() && options.surfaces.empty()) {
    throw CLI::ValidationError("--surface-quality", "expected --output for meshing, found none");
  }
  if (!options.labelmap.empty()) require_labelmap(options.labelmap, "--labelmap");
  if (!options.report.empty()) require_output(options.report, {".json"}, "--report");
  require_page(options.page);
  require_distinct_files(outputs_of(options), inputs_of(options));
}

/// A preview makes no mesh.
void require_mesh_for(const SegmentOptions& options, const Settings& settings) {
  if (settings.preview && options.wants_mesh()) {
    throw CLI::ValidationError("--preview", "expected neither --mesh nor --band-mesh, found one");
  }
}

/// Elements fill a solid, and a material needs the grey values of the scan.
void require_body_for(const SegmentOptions& options, const Settings& settings) {
  require_elements_for(options.body, settings);
  if (!options.body.material.empty() && tissue_kind(options.scan.places) != TissueKind::kBright) {
    throw CLI::ValidationError("--material",
                               "expected a bright --tissue, whose grey values are those of the "
                               "scan, found " +
                                   options.scan.places.tissue);
  }
}

/// What needs no scan to be refused.
void require_places(const SegmentOptions& options, const Settings& settings) {
  const PlaceArguments& places = options.scan.places;
  require_places(places, options.scan.labels, settings);
  if (options.scan.input.empty() && places.given()) {
    throw CLI::ValidationError("input", "expected a scan for the options of places, found none");
  }
  if (tissue_kind(places) != TissueKind::kBright && !options.meshes.empty()) {
    throw CLI::ValidationError("--mesh",
                               "expected a bright --tissue, whose grey values are those "
                               "of the scan, found " +
                                   places.tissue);
  }
}

void write_labelmap(const fs::path& path, const TriMesh& surface, const VoxelGrid& grid) {
  const FoundObject object{surface, {"object", 1, 0, default_colour(1)}};
  write_label_map(path, label_map_of(grid, {&object, 1}));
}

/// Warns where the surface may show something else than what was meant.
/// @return the warnings.
std::vector<std::string> log_surface(const ChosenObject& object, const Parameters& p) {
  if (p.surface != SurfaceKind::kSolid) return {};
  std::vector<std::string> warnings = surface_warnings(object, p.level);
  for (const std::string& warning : warnings) log_warning(warning);
  return warnings;
}

/// Refers to the result.
RunRecord record_of(const Result& result, nlohmann::ordered_json found, const Verdict& verdict,
                    std::vector<std::string> warnings) {
  RunRecord record{std::move(found), std::move(warnings), verdict, {}};
  if (!result.surface.triangles.empty()) {
    record.surfaces.push_back({&result.surface, {}, default_colour(1)});
  }
  if (!result.mesh.cells.empty()) {
    record.mesh = &result.mesh;
    record.grey = result.u;
  }
  return record;
}

void show_run(const ChosenScan& scan, const Result& result, const SurfaceCheck& check,
              const Paths& files) {
  const std::string& tissue = scan.object.tissue;
  RunFigures figures = figures_of(result, check, scan.grid.modality);
  if (!tissue.empty()) figures.object = tissue;
  figures.files = files;
  show_summary(figures);
}

/// Enough once the limit has passed.
HasEnough time_limit(const SegmentOptions& options) {
  if (!options.time_limit) return {};
  return [limit = *options.time_limit] { return wall_seconds() >= limit; };
}

void warn_of_missing_meshes(const SegmentOptions& options, const Result& result) {
  if (!result.mesh.cells.empty() || (options.meshes.empty() && options.band_meshes.empty())) return;
  log_warning("--time-limit: no mesh was made in this time, none is written");
}

/// Makes the elements that are asked for. The surface of the result becomes theirs where it is to
/// suit other meshers.
ElementResults fill_surface(const SegmentOptions& options, Result& result, const Volume& volume,
                            const RunContext& run) {
  if (!options.body.elements()) return {};
  require_surface(result);
  const std::vector<FoundObject> objects{{result.surface, {"object", 1, 0, default_colour(1)}}};
  ElementResults elements = make_elements(
      options.body, {objects, volume, volume, options.scan.frame, result.parameters.blur}, run);
  if (!elements.surfaces.empty()) {
    take_surface(std::move(elements.surfaces.front()), result.surface, result.expected_error);
  }
  return elements;
}

/// @param mesh  none for a run that was stopped before its first mesh.
void write_meshes(const SegmentOptions& options, const Result& result,
                  const std::optional<MeshOutput>& mesh) {
  if (result.mesh.cells.empty()) return;
  const Frame frame = options.scan.frame;
  for (const fs::path& path : options.meshes) write_mesh(path, *mesh, frame);
  for (const fs::path& path : options.band_meshes) write_band_mesh(path, result, frame);
}

int run_on_scan(const SegmentOptions& options, const Settings& settings,
                const CommonOptions& common, const ChosenScan& scan) {
  ProgressDisplay display(common.quiet);
  Result result = run_on_object(scan.object, settings, display.callback(), time_limit(options));
  const Volume& volume = scan.object.volume;
  const ElementResults elements =
      fill_surface(options, result, volume, {settings, common, display});
  display.finish();
  if (result.stopped) warn_of_missing_meshes(options, result);
  auto warnings = log_surface(scan.object, result.parameters);
  const SurfaceCheck check = check_surface(result.surface);
  const Verdict verdict = judge(result, check);
  std::optional<MeshOutput> mesh;  // before any file is written: it may be refused
  const bool has_mesh = !result.mesh.cells.empty();
  if (has_mesh && !options.meshes.empty()) mesh = make_mesh_output(result, volume, options.mesh);
  if (!options.surfaces.empty()) require_surface(result);
  const auto surface_as = surface_options_for(options, result, scan);
  OutputSet set;
  for (const fs::path& path : options.surfaces) write_surface(path, result.surface, surface_as);
  write_meshes(options, result, mesh);
  if (elements.body) write_bodies(options.body, *elements.body, options.scan.frame);
  if (!options.labelmap.empty()) write_labelmap(options.labelmap, result.surface, scan.grid);
  if (options.wants_report()) {
    auto run = run_json(settings, result, check);
    if (mesh) run["mesh"]["region"] = region_json(*mesh);
    if (elements.body) run["body"] = body_json(*elements.body);
    if (!elements.quality.empty()) {
      run["surface"]["meshing"] = meshing_json(elements.quality.front());
    }
    write_record(options, scan, record_of(result, std::move(run), verdict, std::move(warnings)),
                 set);
  }
  const Paths files = files_of(set);
  commit(set);
  show_run(scan, result, check, files);
  if (verdict.outcome != Outcome::kKept) log_error(verdict.message);
  return status_with(elements, exit_status(verdict.outcome));
}

void require_one_object(const SegmentOptions& options, bool several) {
  if (!several || !options.time_limit) return;
  throw CLI::ValidationError("--time-limit", "expected a run for one object, found several");
}

int print_plan(const SegmentOptions& options, const Settings& settings) {
  const ScanArguments& scan = options.scan;
  if (scan.input.empty() && !scan.labels.given()) {
    throw CLI::ValidationError("input", "expected a scan, found none");
  }
  std::cout << run_plan(scan, settings, options.wants_mesh()).dump(2) << "\n";
  return kExitDone;
}

int run_checked(const SegmentOptions& options, const CommonOptions& common) {
  const Settings settings = settings_of(options.settings);
  if (!options.plan) require_outputs(options);
  require_places(options, settings);
  require_mesh_for(options, settings);
  require_body_for(options, settings);
  require_one_object(options, options.scan.labels.given());
  if (options.plan) return print_plan(options, settings);
  if (options.slabs.given()) {
    require_slabs(options, settings);
    if (options.time_limit) {
      throw CLI::ValidationError("--time-limit", "expected a run without --slabs, found one");
    }
    return run_slabs(options, options.slabs, settings, common);
  }
  if (common.team->size() > 1) {
    throw CLI::ValidationError("--slabs", "expected it for a run of several processes, found none");
  }
  if (options.scan.labels.given()) return run_labels(options, settings, common);
  if (options.scan.input.empty()) {
    throw CLI::ValidationError("input", "expected a scan, found none");
  }
  const ChosenScan scan = read_chosen_scan(options.scan, settings, common.limits.memory_gb);
  require_one_object(options, scan.object.parts.has_value());
  if (scan.object.parts) return run_parts(options, settings, scan, common);
  return run_on_scan(options, settings, common, scan);
}

}  // namespace

int run_segment(SegmentOptions options, const CommonOptions& common) {
  ScanArguments& scan = options.scan;
  scan.report = options.wants_report();
  options.command = common.arguments;
  scan.read.limits = scan.places.limits = scan.labels.limits = common.limits;
  return run_checked(options, common);
}

void add_segment_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<SegmentOptions>();
  CLI::App* command = app.add_subcommand("segment", "Segment a scan: surface, mesh, report");
  command->add_option("input", options->scan.input,
                      "Volume file, DICOM directory or file; with --labels it may be left out");
  command->add_option("-o,--output", options->surfaces,
                      listed("Surface:", written_surface_formats()));
  command->add_flag("--error", options->error,
                    "Write the error expected at each point, mm, into --output .vtp and .ply, as "
                    "expected_error");
  command->add_flag("--patient", options->scan.patient,
                    "Copy patient, study and frame of reference of the DICOM scan into --output "
                    ".dcm; without it a .dcm names no patient");
  add_mesh_options(*command, options);
  add_body_options(*command, options->body);
  add_place_options(*command, options->scan.places);
  add_label_options(*command, options->scan.labels);
  command->add_option("--labelmap", options->labelmap,
                      "What was found, voxel by voxel on the scan's grid: .nii .nii.gz .nrrd "
                      ".seg.nrrd");
  command->add_option("--report", options->report, "Report: .json");
  add_page_options(*command, options->page);
  add_read_options(*command, options->scan.read);
  add_frame_option(*command, options->scan.frame);
  command
      ->add_option("--time-limit", options->time_limit,
                   "Seconds after which no further mesh is begun; the surface of the last one is "
                   "written (exit status 4)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--plan", options->plan,
                    "Read headers alone and print what the run needs of memory, as JSON; outputs "
                    "are neither needed nor written");
  command->add_option("--name", options->name, "The object's name in the surfaces written");
  add_slab_options(*command, options->slabs);
  add_settings_options(*command, options->settings);
  command->callback([options, &common, &action] {
    action = [options, &common] { return run_segment(*options, common); };
  });
}

}  // namespace mesamis
