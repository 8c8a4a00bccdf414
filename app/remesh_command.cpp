// SPDX-License-Identifier: Apache-2.0
// mesamis remesh: the box remesher alone, Medit files in and out.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "costs.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/remesh/adapt_mesh.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/remesh_json.h"
#include "mesamis/report/report.h"
#include "mesamis/shape_files/mesh_files.h"
#include "outputs.h"
#include "progress.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct RemeshCommand {
  fs::path mesh, metric, output, report;
  std::int64_t max_tets = 0;
};

struct Background {
  TetMesh mesh;
  std::vector<Sym3> metrics;
};

Background read_background(const RemeshCommand& command, const ReadLimits& limits) {
  Background background{read_medit_mesh(command.mesh, limits),
                        read_medit_metric(command.metric, limits)};
  const std::string flaw = find_flaw(background.mesh, bounding_box(background.mesh.points));
  if (!flaw.empty()) {
    throw InputError(command.mesh.string() + ": not a mesh of its bounding box: " + flaw);
  }
  if (background.metrics.size() != background.mesh.points.size()) {
    throw InputError(command.metric.string() + ": expected " +
                     std::to_string(background.mesh.points.size()) + " metrics, one per vertex, " +
                     "found " + std::to_string(background.metrics.size()));
  }
  try {
    require_positive_definite(background.metrics);
  } catch (const InputError& error) {
    throw InputError(command.metric.string() + ": " + error.what());
  }
  return background;
}

AdaptedMesh build(const Background& background, const RemeshCommand& command, bool quiet) {
  ProgressDisplay display(quiet);
  RemeshOptions options;
  options.max_cells = command.max_tets;
  options.progress = display.callback();
  return adapt_mesh(background.mesh, background.metrics, options);
}

void write_report(const RemeshCommand& command, const Background& background,
                  const AdaptedMesh& adapted, OutputSet& set) {
  nlohmann::ordered_json report;
  report["program"] = program_json();
  report["input"] = {{"mesh", command.mesh.string()},
                     {"metric", command.metric.string()},
                     {"tets", background.mesh.cells.size()},
                     {"nodes", background.mesh.points.size()},
                     {"complexity", complexity(background.mesh, background.metrics)}};
  report["settings"] = {{"max_tets", command.max_tets > 0 ? json(command.max_tets) : json()},
                        {"start", adapted.kept_start ? "mesh" : "box"}};
  report["mesh"] = fit_json(adapted);
  report["remesh"] = remesh_json(adapted.report);
  report["converged"] = adapted.report.converged;
  report["files"] = files_json(set);
  add_costs(report);
  write_json(set.file(command.report), report);
}

int run_remesh(const RemeshCommand& command, const CommonOptions& common) {
  require_output(command.output, {".mesh"}, "--output");
  if (!command.report.empty()) require_output(command.report, {".json"}, "--report");
  require_distinct_files({command.output, command.report}, {command.mesh, command.metric});
  const Background background = read_background(command, common.limits);
  const AdaptedMesh adapted = build(background, command, common.quiet);
  OutputSet set;
  write_medit_mesh(set.file(command.output), adapted.mesh);
  if (!command.report.empty()) write_report(command, background, adapted, set);
  commit(set);
  std::cout << adapted.mesh.cells.size() << " tetrahedra, " << adapted.mesh.points.size()
            << " vertices, " << 100 * adapted.fit.unit_edge_fraction
            << " % unit edges, quality at least " << adapted.fit.quality_min << ", on average "
            << adapted.fit.quality_mean << "\n";
  if (adapted.report.converged) return kExitDone;
  log_error("remesh: not converged after " + std::to_string(adapted.report.rounds) +
            " rounds; the mesh is valid and written");
  return kExitNotConverged;
}

}  // namespace

void add_remesh_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<RemeshCommand>();
  CLI::App* command = app.add_subcommand("remesh", "Adapt a mesh of a box to a metric");
  command->add_option("mesh", options->mesh, "Mesh of a box: Medit .mesh")->required();
  command->add_option("--metric", options->metric, "Metric at its vertices: Medit .sol")
      ->required();
  command->add_option("-o,--output", options->output, "The new mesh: Medit .mesh")->required();
  command->add_option_function<double>(
      "--max-tets",
      [options](double count) {
        if (!(count >= 1 && count <= 2e8 && count == std::floor(count))) {
          throw CLI::ValidationError("--max-tets", "expected a whole number from 1 to 2e8");
        }
        options->max_tets = static_cast<std::int64_t>(count);
      },
      "Coarsen the metric until the mesh has about this many cells");
  command->add_option("--report", options->report, "Report: .json");
  command->callback([options, &common, &action] {
    action = [options, &common] { return run_remesh(*options, common); };
  });
}

}  // namespace mesamis
