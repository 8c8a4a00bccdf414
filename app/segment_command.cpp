// SPDX-License-Identifier: Apache-2.0
// mesamis segment: a scan in, a surface, an adapted mesh and a report out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "costs.h"
#include "label_options.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/base/version.h"
#include "mesamis/delivery/label_output.h"
#include "mesamis/delivery/mesh_output.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/method/memory.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/record/json_file.h"
#include "mesamis/record/report.h"
#include "mesamis/record/settings_json.h"
#include "mesamis/record/verdict.h"
#include "mesamis/scan_files/read_volume.h"
#include "mesamis/shape_files/surface_files.h"
#include "outputs.h"
#include "progress.h"
#include "scan.h"
#include "segment_labels.h"
#include "settings_options.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct SegmentOptions {
  fs::path input, report, labelmap;
  std::vector<fs::path> surfaces, meshes, band_meshes;
  ReadOptions read;
  std::string name = "mesamis surface";  // never the scan's, which may be the patient's
  Frame frame = Frame::kLps;
  bool error = false;
  MeshOptions mesh;
  LabelArguments labels;
  SettingsArguments settings;
};

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

SurfaceWriteOptions surface_options(const SegmentOptions& options, const Result& result,
                                    double voxel) {
  const bool grey = !result.mesh.cells.empty() &&
                    std::any_of(options.surfaces.begin(), options.surfaces.end(), carries_grey);
  const std::string program = std::string("mesamis ") + version() + " (" + commit() + ")";
  SurfaceWriteOptions as{
      options.frame,
      options.name + (result.parameters.preview ? " (preview)" : ""),
      grey ? surface_grey(result, voxel) : std::vector<double>{},
      {{"producer", program}, {"settings", to_json(settings_of(result.parameters)).dump()}}};
  if (options.error && !result.expected_error.empty()) {
    as.point_arrays.push_back({"expected_error", result.expected_error});
  }
  return as;
}

/// A run whose result nobody would see is not started.
void require_some_output(const SegmentOptions& options) {
  if (!options.surfaces.empty() || !options.meshes.empty() || !options.band_meshes.empty() ||
      !options.labelmap.empty() || !options.report.empty()) {
    return;
  }
  throw CLI::ValidationError(
      "segment",
      "expected --output, --mesh, --band-mesh, --labelmap or --report, found nothing to write");
}

void require_outputs(const SegmentOptions& options) {
  require_some_output(options);
  for (const fs::path& path : options.surfaces) {
    require_output(path, written_surface_formats(), "--output");
  }
  if (options.error &&
      std::none_of(options.surfaces.begin(), options.surfaces.end(), carries_arrays)) {
    throw CLI::ValidationError("--error", "expected a .vtp or .ply among --output, found none");
  }
  for (const fs::path& path : options.meshes) {
    require_output(path, written_mesh_formats(), "--mesh");
  }
  for (const fs::path& path : options.band_meshes) require_output(path, {".vtu"}, "--band-mesh");
  if (!options.labelmap.empty()) require_labelmap(options.labelmap);
  if (!options.report.empty()) require_output(options.report, {".json"}, "--report");
}

/// A preview makes no mesh, and without one there are no grey values below the surface.
void require_mesh_for(const SegmentOptions& options, const Settings& settings) {
  if (!settings.preview) return;
  if (!options.meshes.empty() || !options.band_meshes.empty()) {
    throw CLI::ValidationError("--preview", "expected neither --mesh nor --band-mesh, found one");
  }
}

/// There must be something to write; which bound left nothing is what the user can change.
void require_surface(const Result& result) {
  if (!result.surface.triangles.empty()) return;
  if (result.parameters.surface == SurfaceKind::kBand) {
    throw InputError(
        fmt::format("surface: expected cells with v below --band-threshold {}, found none",
                    result.parameters.band_threshold));
  }
  const auto& parts = result.printable.parts;
  if (parts && parts->islands_dropped > 0) {
    throw InputError(
        fmt::format("surface: expected a part of at least --min-volume {} mm^3, found none",
                    result.parameters.min_volume));
  }
  throw InputError(fmt::format("surface: expected values above --level {}, found none",
                               result.parameters.level));
}

/// What a label map leaves no room for.
void require_no_mesh(const SegmentOptions& options) {
  if (!options.meshes.empty() || !options.band_meshes.empty()) {
    throw CLI::ValidationError("--labels", "expected neither --mesh nor --band-mesh, found one");
  }
}

int run_with_labels(const SegmentOptions& o, const Settings& settings,
                    const CommonOptions& common) {
  require_no_mesh(o);
  return run_labels({o.input, o.read, o.labels, o.surfaces, o.labelmap, o.report, o.name, o.frame,
                     o.error, settings},
                    common);
}

void write_labelmap(const fs::path& path, const TriMesh& surface, const VoxelGrid& grid) {
  const FoundObject object{surface, {"object", 1, 0, default_colour(1)}};
  write_label_map(path, label_map_of(grid, {&object, 1}));
}

int run_segment(const SegmentOptions& options, const CommonOptions& common) {
  const Settings settings = settings_of(options.settings);
  require_outputs(options);
  if (options.labels.given()) return run_with_labels(options, settings, common);
  if (options.input.empty()) throw CLI::ValidationError("input", "expected a scan, found none");
  require_mesh_for(options, settings);
  const VolumeFile file = read_scan(options.input, options.read);
  require_memory(file.volume, settings, common.memory_gb);
  ProgressDisplay display(common.quiet);
  const Result result = mes_amis(file.volume, settings, display.callback());
  display.finish();
  const SurfaceCheck check = check_surface(result.surface);
  std::optional<MeshOutput> mesh;  // before any file is written: it may be refused
  if (!options.meshes.empty()) mesh = make_mesh_output(result, file.volume, options.mesh);
  if (!options.surfaces.empty()) require_surface(result);
  const auto surface_as = surface_options(options, result, file.volume.voxel_size());
  for (const fs::path& path : options.surfaces) write_surface(path, result.surface, surface_as);
  for (const fs::path& path : options.meshes) write_mesh(path, *mesh, options.frame);
  if (!options.labelmap.empty()) write_labelmap(options.labelmap, result.surface, file.volume);
  for (const fs::path& path : options.band_meshes) write_band_mesh(path, result, options.frame);
  if (!options.report.empty()) {
    nlohmann::ordered_json report;
    report["program"] = program_json();
    report["input"] = input_json(facts_of(options.input, file.volume, file.format, file.warnings));
    report["output"] = output_json(options.frame);
    report.update(run_json(settings, result, check));
    if (mesh) report["mesh"]["region"] = region_json(*mesh);
    add_costs(report);
    write_json(options.report, report);
  }
  const Verdict verdict = judge(result, check);
  if (verdict.outcome != Outcome::kKept) log_error(verdict.message);
  return exit_status(verdict.outcome);
}

}  // namespace

void add_segment_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<SegmentOptions>();
  CLI::App* command = app.add_subcommand("segment", "Segment a scan: surface, mesh, report");
  command->add_option("input", options->input,
                      "Volume file, DICOM directory or file; with --labels it may be left out");
  command->add_option("-o,--output", options->surfaces,
                      listed("Surface:", written_surface_formats()));
  command->add_flag("--error", options->error,
                    "Write the error expected at each point, mm, into --output .vtp and .ply, as "
                    "expected_error");
  add_mesh_options(*command, options);
  add_label_options(*command, options->labels);
  command->add_option("--labelmap", options->labelmap,
                      "What was found, voxel by voxel on the scan's grid: .nii .nii.gz .nrrd "
                      ".seg.nrrd");
  command->add_option("--report", options->report, "Report: .json");
  add_read_options(*command, options->read);
  add_frame_option(*command, options->frame);
  command->add_option("--name", options->name, "The object's name in the surfaces written");
  add_settings_options(*command, options->settings);
  command->callback([options, &common, &action] {
    action = [options, &common] { return run_segment(*options, common); };
  });
}

}  // namespace mesamis
