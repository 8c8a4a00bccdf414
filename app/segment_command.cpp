// SPDX-License-Identifier: Apache-2.0
// mesamis segment: a scan in, a surface, an adapted mesh and a report out.
#include <CLI/CLI.hpp>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "arguments.h"
#include "commands.h"
#include "json_file.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/io/read_volume.h"
#include "mesamis/io/surface_files.h"
#include "mesamis/mes_amis.h"
#include "mesh_output.h"
#include "outputs.h"
#include "progress.h"
#include "report.h"
#include "scan.h"
#include "settings_json.h"
#include "version.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct SegmentOptions {
  fs::path input, settings_file, report;
  std::vector<fs::path> surfaces, meshes, band_meshes;
  std::string series;
  std::string name = "mesamis surface";  // never the scan's, which may be the patient's
  Frame frame = Frame::kLps;
  MeshOptions mesh;
  json overrides = json::object();  // settings given as options, on top of the file's
};

/// "I0:I1,J0:J1,K0:K1"; an empty bound is the volume's own.
json crop_ranges(const std::string& text) {
  json ranges = json::array();
  std::stringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    const auto colon = part.find(':');
    if (colon == std::string::npos) {
      throw CLI::ValidationError("--crop", "expected I0:I1,J0:J1,K0:K1, found " + text);
    }
    auto bound = [](const std::string& number, int otherwise) {
      return number.empty() ? otherwise : parse_integers(number, 1, "--crop")[0];
    };
    ranges.push_back({bound(part.substr(0, colon), 0), bound(part.substr(colon + 1), -1)});
  }
  if (ranges.size() != 3) throw CLI::ValidationError("--crop", "expected three ranges");
  return ranges;
}

/// A number, or one of the words allowed.
json number_or_word(const std::string& text, const std::vector<std::string>& words,
                    const std::string& option) {
  for (const std::string& word : words) {
    if (text == word) return word;
  }
  double value = 0;
  if (parse_number(text, value)) return value;
  throw CLI::ValidationError(option, "'" + text + "' is neither a number nor a word it knows");
}

/// Adds an option whose text becomes one entry of the overrides.
using Parse = std::function<json(const std::string&)>;
void add_setting(CLI::App& command, const std::shared_ptr<SegmentOptions>& options,
                 const std::string& flag, const std::string& help, const Parse& parse) {
  std::string key = flag.substr(2);
  std::replace(key.begin(), key.end(), '-', '_');
  command
      .add_option_function<std::string>(
          flag, [=](const std::string& text) { options->overrides[key] = parse(text); }, help)
      ->group("Settings");
}

void add_number(CLI::App& command, const std::shared_ptr<SegmentOptions>& options,
                const std::string& flag, const std::string& help,
                const std::vector<std::string>& words = {}) {
  add_setting(command, options, flag, help,
              [=](const std::string& text) { return number_or_word(text, words, flag); });
}

void add_word(CLI::App& command, const std::shared_ptr<SegmentOptions>& options,
              const std::string& flag, const std::string& help) {
  add_setting(command, options, flag, help, [](const std::string& text) { return json(text); });
}

/// "1", "1,1,2", "none" or "auto" as the setting has it: three numbers or a word.
json blur_of_axes(const std::string& text) {
  if (text == "auto") return json(text);
  if (text == "none") return json({0, 0, 0});
  double value = 0;
  if (parse_number(text, value)) return json({value, value, value});
  return json(parse_numbers(text, 3, "--blur"));
}

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

void add_image_settings(CLI::App& c, const std::shared_ptr<SegmentOptions>& o) {
  add_setting(c, o, "--crop", "Voxels to use, I0:I1,J0:J1,K0:K1 (ends excluded, may be empty)",
              crop_ranges);
  add_setting(c, o, "--stride", "Voxels per node of the first grid, X,Y,Z (default 1,1,1)",
              [](const std::string& text) { return json(parse_integers(text, 3, "--stride")); });
  add_setting(c, o, "--window", "Native values mapped to 0 and 255, LO,HI or auto (default auto)",
              [](const std::string& text) {
                return text == "auto" ? json(text) : json(parse_numbers(text, 2, "--window"));
              });
  add_number(c, o, "--noise", "Standard deviation of the noise, native units, or auto (default)",
             {"auto"});
  add_setting(c, o, "--blur",
              "Blur to undo, standard deviation in voxels: S, X,Y,Z, none or auto (default)",
              blur_of_axes);
  add_number(c, o, "--threshold", "Native value below which all is one tissue, auto or none",
             {"auto", "none"});
  add_number(c, o, "--level", "Native value of the solid surface, or auto", {"auto"});
}

void add_method_settings(CLI::App& c, const std::shared_ptr<SegmentOptions>& o) {
  add_word(c, o, "--length-unit", "Unit of the parameters' lengths: voxel or mm (default voxel)");
  add_number(c, o, "--epsilon", "Thickness of the edge indicator (default 1e-3)");
  add_number(c, o, "--eta", "Smallest diffusion at edges (default epsilon squared)", {"auto"});
  add_number(c, o, "--beta", "Weight of smoothness away from edges (default 2)");
  add_number(c, o, "--gamma",
             "Price of edges, or auto (default): by the contrast and the noise; the paper: 0.1",
             {"auto"});
  add_number(c, o, "--amis-iterations", "Alternations per mesh at most (default 10)");
  add_number(c, o, "--tol-v", "Alternations stop at this change of v (default 1e-2)");
  add_number(c, o, "--solver-tolerance", "Relative residual of each solve (default 1e-6)");
  add_number(c, o, "--max-tets", "Cells of the mesh at most, or auto", {"auto"});
  add_number(c, o, "--tau", "Tolerance on the error estimator (default 1e-2)");
  add_number(c, o, "--adaptations", "Adaptations at most (default 10)");
  add_number(c, o, "--tol-mesh", "Settled: relative change of the cell count (default 1e-2)");
  add_number(c, o, "--tol-energy", "Settled: relative change of the energy (default 1e-2)");
  add_number(c, o, "--max-stretch", "Longest to shortest size of a cell (default 10)");
  add_number(c, o, "--gradation",
             "Growth of sizes from edge to edge at most, above 1 (default 0: any)");
  add_number(c, o, "--h-min", "Smallest edge, in length units (default 0.5)");
  add_number(c, o, "--h-max", "Largest edge, in length units, or auto", {"auto"});
  add_word(c, o, "--surface", "solid: closed level set of u (default); band: the paper's surface");
  add_number(c, o, "--band-threshold", "The band's cells have v below this (default 0.1)");
  add_number(
      c, o, "--min-volume",
      "Drop islands and fill cavities of the solid below so many mm^3 (default auto: 4 voxels)",
      {"auto"});
  add_number(c, o, "--keep-largest", "Islands of the solid to keep (default 0: all)");
  c.add_flag_callback(
       "--fill-cavities", [o] { o->overrides["fill_cavities"] = true; },
       "Fill the cavities of the solid")
      ->group("Settings");
  add_number(c, o, "--tolerance",
             "Decimate the solid surface within this distance, mm (default auto: 0.1 voxel; 0: no)",
             {"auto"});
  add_number(c, o, "--triangles", "Decimate the solid surface to this many", {"auto"});
  c.add_flag_callback(
       "--stop-at-first", [o] { o->overrides["stop_at_first"] = true; },
       "Stop when mesh or energy has settled, as printed in the paper (default: both)")
      ->group("Settings");
}

Settings settings_of(const SegmentOptions& options) {
  Settings settings;
  if (!options.settings_file.empty()) {
    json file = read_json(options.settings_file);
    // A whole report serves as well: its settings are those of the run.
    if (file.is_object() && file.contains("settings")) file = file["settings"];
    try {
      from_json(file, settings);
      require_valid(settings);
    } catch (const InputError& error) {
      throw InputError(options.settings_file.string() + ": " + error.what());
    }
  }
  as_usage([&] {
    from_json(options.overrides, settings);
    require_valid(settings);
  });
  return settings;
}

SurfaceWriteOptions surface_options(const SegmentOptions& options, const Result& result,
                                    double voxel) {
  const bool grey = std::any_of(options.surfaces.begin(), options.surfaces.end(), carries_grey);
  const std::string program = std::string("mesamis ") + kVersion + " (" + kCommit + ")";
  return {options.frame,
          options.name,
          grey ? surface_grey(result, voxel) : std::vector<double>{},
          {{"producer", program}, {"settings", to_json(settings_used(result)).dump()}}};
}

std::string why_not_converged(const Result& result) {
  const auto& passes = result.iterations;
  for (const Iteration& pass : passes) {
    if (!pass.amis.solver_converged) {
      return "not converged: a linear solve ended with a relative residual of " +
             std::to_string(pass.amis.solver_residual) + ", expected " +
             std::to_string(result.settings.solver_tolerance);
    }
  }
  const Iteration& last = passes[passes.size() - 2];
  return "not converged: after " + std::to_string(result.settings.adaptations) +
         " adaptations the cell count changed by " + std::to_string(last.mesh_change) +
         " and the energy by " + std::to_string(last.energy_change) + ", expected at most " +
         std::to_string(result.settings.tol_mesh) + " and " +
         std::to_string(result.settings.tol_energy);
}

void require_outputs(const SegmentOptions& options) {
  for (const fs::path& path : options.surfaces) {
    require_output(path, written_surface_formats(), "--output");
  }
  for (const fs::path& path : options.meshes) {
    require_output(path, written_mesh_formats(), "--mesh");
  }
  for (const fs::path& path : options.band_meshes) require_output(path, {".vtu"}, "--band-mesh");
  if (!options.report.empty()) require_output(options.report, {".json"}, "--report");
}

int run_segment(const SegmentOptions& options, const CommonOptions& common) {
  const Settings settings = settings_of(options);
  require_outputs(options);
  const VolumeFile file = read_scan(options.input, options.series);
  ProgressDisplay display(common.quiet);
  const Result result = mes_amis(file.volume, settings, display.callback());
  display.finish();
  const SurfaceCheck check = check_surface(result.surface);
  std::optional<MeshOutput> mesh;  // before any file is written: it may be refused
  if (!options.meshes.empty()) mesh = make_mesh_output(result, file.volume, options.mesh);
  const auto surface_as = surface_options(options, result, file.volume.voxel_size());
  for (const fs::path& path : options.surfaces) write_surface(path, result.surface, surface_as);
  for (const fs::path& path : options.meshes) write_mesh(path, *mesh, options.frame);
  for (const fs::path& path : options.band_meshes) write_band_mesh(path, result, options.frame);
  if (!options.report.empty()) {
    auto report =
        segment_report(facts_of(options.input, file, options.frame), settings, result, check);
    if (mesh) report["mesh"]["region"] = region_json(*mesh);
    write_json(options.report, report);
  }
  const bool solid = result.settings.surface == SurfaceKind::kSolid;
  const bool encloses = solid && !result.surface.triangles.empty();
  const std::string flaws = encloses ? solid_flaws_of(check) : flaws_of(check);
  if (!flaws.empty()) {
    log_error("expected a closed 2-manifold surface that faces outward, found " + flaws);
    return kExitNotClosed;
  }
  const auto& tolerance = result.settings.tolerance;
  if (solid && tolerance && !result.printable.within(*tolerance)) {
    log_error(tolerance_unmet(*tolerance, result.printable));
    return kExitNotConverged;
  }
  if (result.converged) return kExitDone;
  log_error(why_not_converged(result));
  return kExitNotConverged;
}

}  // namespace

void add_segment_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<SegmentOptions>();
  CLI::App* command = app.add_subcommand("segment", "Segment a scan: surface, mesh, report");
  command->add_option("input", options->input, "Volume file, DICOM directory or file")->required();
  command->add_option("-o,--output", options->surfaces,
                      listed("Surface:", written_surface_formats()));
  add_mesh_options(*command, options);
  command->add_option("--report", options->report, "Report: .json");
  command->add_option("--series", options->series, "DICOM series UID");
  command->add_option("--settings", options->settings_file, "Settings or a report: .json");
  command
      ->add_option_function<std::string>(
          "--frame",
          [options](const std::string& name) {
            options->frame = name == "ras" ? Frame::kRas : Frame::kLps;
          },
          "Frame of the files written (default lps)")
      ->check(CLI::IsMember({"lps", "ras"}));
  command->add_option("--name", options->name, "The object's name in the surfaces written");
  add_image_settings(*command, options);
  add_method_settings(*command, options);
  command->callback([options, &common, &action] {
    action = [options, &common] { return run_segment(*options, common); };
  });
}

}  // namespace mesamis
