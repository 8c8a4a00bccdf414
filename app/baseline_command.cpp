// SPDX-License-Identifier: Apache-2.0
// mesamis baseline: surfaces of other methods, to compare with.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "arguments.h"
#include "commands.h"
#include "costs.h"
#include "log.h"
#include "mesamis/baseline/baseline_surface.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/report.h"
#include "mesamis/shape_files/surface_files.h"
#include "outputs.h"
#include "progress.h"
#include "scan.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct BaselineCommand {
  fs::path input, output, report;
  std::string method = "isosurface";
  ReadOptions read;
  std::optional<double> level;
  std::optional<double> smooth;
  IsosurfaceOptions isosurface;
  GeodesicOptions geodesic;
  std::vector<const CLI::Option*> geodesic_only;

  bool is_geodesic() const { return method == "geodesic"; }
  double smoothing() const {
    return smooth.value_or(is_geodesic() ? geodesic.smooth_voxels : isosurface.smooth_voxels);
  }
};

BaselineOptions options_of(const BaselineCommand& command) {
  BaselineOptions options;
  options.method = command.is_geodesic() ? BaselineMethod::kGeodesic : BaselineMethod::kIsosurface;
  options.level = command.level;
  options.isosurface = command.isosurface;
  options.geodesic = command.geodesic;
  if (command.smooth) {
    options.isosurface.smooth_voxels = options.geodesic.smooth_voxels = *command.smooth;
  }
  return options;
}

/// Refuses what is wrong with the command line before any work is done.
void require_all(const BaselineCommand& command) {
  require_output(command.output, written_surface_formats(), "--output");
  if (!command.report.empty()) require_output(command.report, {".json"}, "--report");
  require_distinct_files({command.output, command.report}, {command.input});
  if (!has_isosurface()) {
    throw CLI::ValidationError("baseline: not in this program, which was built without VTK");
  }
  if (command.is_geodesic() && !has_geodesic_contour()) {
    throw CLI::ValidationError(
        "--method geodesic: not in this program, which was built without ITK");
  }
  for (const CLI::Option* option : command.geodesic_only) {
    if (command.is_geodesic() || option->count() == 0) continue;
    throw CLI::ValidationError(option->get_name() + " is for --method geodesic");
  }
  as_usage([options = options_of(command)] {
    options.method == BaselineMethod::kGeodesic ? require_valid(options.geodesic)
                                                : require_valid(options.isosurface);
  });
}

BaselineSurface run_method(const Volume& volume, const BaselineCommand& command, bool quiet) {
  ProgressDisplay display(quiet);
  return make_baseline(volume, options_of(command), display.callback());
}

/// With the values used, so that a run can be repeated from its report.
ordered_json settings_json(const BaselineCommand& command, const BaselineSurface& made) {
  ordered_json json{{"method", command.method},
                    {"level", made.level},
                    {"smooth", command.smoothing()},
                    {"triangles", command.isosurface.triangles},
                    {"close", command.isosurface.close_at_box}};
  if (!made.contour) return json;
  const GeodesicOptions& g = command.geodesic;
  json.update({{"diffusions", g.diffusions},
               {"conductance", g.conductance},
               {"sigma", g.sigma},
               {"alpha", made.contour->alpha},
               {"beta", made.contour->beta},
               {"shrink", g.shrink},
               {"propagation", g.propagation},
               {"curvature", g.curvature},
               {"advection", g.advection},
               {"iterations", g.iterations},
               {"rms_change", g.rms_change}});
  return json;
}

/// Names of the settings that were left to the program.
ordered_json chosen(const BaselineCommand& command) {
  ordered_json names = ordered_json::array();
  if (!command.level) names.push_back("level");
  if (command.is_geodesic() && !command.geodesic.alpha) names.push_back("alpha");
  if (command.is_geodesic() && !command.geodesic.beta) names.push_back("beta");
  return names;
}

void write_report(const BaselineCommand& command, const BaselineSurface& made, OutputSet& set) {
  ordered_json report;
  report["program"] = program_json();
  report["input"] = {{"path", command.input.string()}};
  report["settings"] = settings_json(command, made);
  report["chosen"] = chosen(command);
  if (made.contour) {
    report["contour"] = {{"edge_gradient", made.contour->edge_gradient},
                         {"flat_gradient", made.contour->flat_gradient},
                         {"iterations", made.contour->iterations},
                         {"rms_change", made.contour->rms_change}};
  }
  report["surface"] = check_json(made.surface, check_surface(made.surface));
  report["converged"] = made.converged();
  report["seconds_parts"] = {{"method", made.seconds}};
  report["files"] = files_json(set);
  add_costs(report);
  write_json(set.file(command.report), report);
}

std::string why_not_converged(const GeodesicReport& contour, const GeodesicOptions& options) {
  std::ostringstream line;
  line << "not converged: after " << contour.iterations << " iterations the contour moved by "
       << contour.rms_change << " voxels in the last 20, expected less than " << options.rms_change;
  return line.str();
}

/// The decimation stops where nothing is left to collapse, and adds no triangle.
void warn_of_triangles(std::size_t asked, std::size_t found) {
  constexpr double kTolerance = 0.05;  // the goal is met about
  const auto goal = static_cast<double>(asked);
  if (asked == 0 || std::abs(static_cast<double>(found) - goal) <= kTolerance * goal) return;
  log_warning(fmt::format(
      "--triangles: expected about {}, found {}: {}", asked, found,
      found < asked ? "the surface has no more" : "the decimation of VTK goes no further"));
}

int run_baseline(const BaselineCommand& command, const CommonOptions& common) {
  require_all(command);
  const VolumeFile file = read_scan(command.input, command.read);
  const BaselineSurface made = run_method(file.volume, command, common.quiet);
  warn_of_triangles(command.isosurface.triangles, made.surface.triangles.size());
  OutputSet set;
  write_surface(set.file(command.output), made.surface);
  if (!command.report.empty()) write_report(command, made, set);
  commit(set);
  std::cout << made.surface.triangles.size() << " triangles ";
  if (made.contour)
    std::cout << "after " << made.contour->iterations << " iterations from ";
  else
    std::cout << "at ";
  std::cout << "level " << made.level << "\n";
  if (made.converged()) return kExitDone;
  log_error(why_not_converged(*made.contour, command.geodesic));
  return kExitNotConverged;
}

void add_geodesic_options(CLI::App& sub, BaselineCommand& c) {
  GeodesicOptions& g = c.geodesic;
  const auto add = [&sub, &c](const char* flag, auto& value, const char* help) {
    c.geodesic_only.push_back(sub.add_option(flag, value, help)->group("Geodesic"));
  };
  add("--diffusions", g.diffusions, "Steps of anisotropic diffusion after --smooth (default 0)");
  add("--conductance", g.conductance, "Conductance of the diffusion (default 1)");
  add("--sigma", g.sigma, "Width of the Gaussian before the gradient, voxels (default 0.7)");
  add("--alpha", g.alpha,
      "Width of the gradient's sigmoid, native per mm, below 0 (default: chosen)");
  add("--beta", g.beta, "Centre of that sigmoid, native per mm (default: chosen)");
  add("--shrink", g.shrink,
      "Distance of the initial contour inside the level's surface, voxels (default 0)");
  add("--propagation", g.propagation, "Weight of growth (default 0.05)");
  add("--curvature", g.curvature, "Weight of straightening (default 0.05)");
  add("--advection", g.advection, "Weight of the pull towards edges (default 1)");
  add("--iterations", g.iterations, "Greatest number of iterations (default 1000)");
  add("--rms-change", g.rms_change,
      "Stop when 20 iterations move the contour by less, rms, voxels (default 0.03)");
}

}  // namespace

void add_baseline_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto command = std::make_shared<BaselineCommand>();
  CLI::App* sub = app.add_subcommand(
      "baseline",
      "Surfaces to compare with: an isosurface of the voxels, or a geodesic active contour");
  sub->add_option("input", command->input, "Volume file, DICOM directory or file")->required();
  sub->add_option("-o,--output", command->output, listed("Surface:", written_surface_formats()))
      ->required();
  sub->add_option("--method", command->method, "isosurface, or geodesic (ITK's)")
      ->check(CLI::IsMember({"isosurface", "geodesic"}))
      ->capture_default_str();
  sub->add_option(
      "--level", command->level,
      "Native value (default: midway between the values 1.5 voxels outside and inside the "
      "object's edges in the scan; segment's default may differ)");
  sub->add_option("--smooth", command->smooth,
                  "Sigma of a Gaussian applied first, voxels (default 0; geodesic: 0.5)");
  sub->add_option("--triangles", command->isosurface.triangles,
                  "Decimate to about this many triangles; warns if that is not possible");
  sub->add_flag("--close", command->isosurface.close_at_box,
                "Close the surface where the object leaves the volume");
  add_geodesic_options(*sub, *command);
  add_read_options(*sub, command->read);
  sub->add_option("--report", command->report, "Report: .json");
  sub->callback([command, &common, &action] {
    action = [command, &common] {
      command->read.limits = common.limits;
      return run_baseline(*command, common);
    };
  });
}

}  // namespace mesamis
