// SPDX-License-Identifier: Apache-2.0
// mesamis remesh: the box remesher alone, Medit files in and out.
#include <cmath>
#include <iostream>
#include <memory>

#include "commands.h"
#include "json_file.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/io/mesh_files.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/remesh/remesh.h"
#include "outputs.h"
#include "progress.h"
#include "report.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A start mesh whose edges already fit the metric this well is worth keeping; otherwise it is
// faster to refine a coarse box than to coarsen or rebuild what is there.
constexpr double kFitToKeep = 0.5;

struct RemeshCommand {
  fs::path mesh, metric, output, report;
  std::int64_t max_tets = 0;
};

struct Background {
  TetMesh mesh;
  std::vector<Sym3> metrics;
};

Background read_background(const RemeshCommand& command) {
  Background background{read_medit_mesh(command.mesh), read_medit_metric(command.metric)};
  const std::string flaw = find_flaw(background.mesh, bounding_box(background.mesh.points));
  if (!flaw.empty()) {
    throw InputError(command.mesh.string() + ": not a mesh of its bounding box: " + flaw);
  }
  if (background.metrics.size() != background.mesh.points.size()) {
    throw InputError(command.metric.string() + ": expected " +
                     std::to_string(background.mesh.points.size()) + " metrics, one per vertex, " +
                     "found " + std::to_string(background.metrics.size()));
  }
  return background;
}

/// The metric as a field; what it refuses is the metric file's fault.
MeshMetricField metric_field(const Background& background, const fs::path& file) {
  try {
    return {background.mesh, background.metrics};
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

MeshFit fit_of(const TetMesh& mesh, const MetricField& field) {
  return measure_fit(mesh, sample(field, mesh.points));
}

struct Outcome {
  bool kept_start = false;
  TetMesh mesh;
  RemeshReport remesh;
  MeshFit fit;
};

Outcome build(const Background& background, const RemeshCommand& command, bool quiet) {
  const MeshMetricField field = metric_field(background, command.metric);
  Outcome outcome;
  outcome.kept_start =
      measure_fit(background.mesh, background.metrics).unit_edge_fraction >= kFitToKeep;
  ProgressDisplay display(quiet);
  RemeshOptions options;
  options.max_cells = command.max_tets;
  options.progress = display.callback();
  const TetMesh start =
      outcome.kept_start ? background.mesh : coarse_box_mesh(bounding_box(background.mesh.points));
  outcome.mesh = remesh(start, field, options, &outcome.remesh);
  outcome.fit = fit_of(outcome.mesh, ScaledMetricField(field, outcome.remesh.size_factor));
  return outcome;
}

/// An edge by its vertices as Medit counts them, from 1, and where it is.
nlohmann::ordered_json edge_json(const TetMesh& mesh, const Edge& edge, double length) {
  return {{"length", length},
          {"vertices", {edge[0] + 1, edge[1] + 1}},
          {"middle", vec_json(0.5 * (mesh.points[edge[0]] + mesh.points[edge[1]]))}};
}

nlohmann::ordered_json worst_cell_json(const TetMesh& mesh, const MeshFit& fit) {
  const auto [a, b, c, d] = cell_corners(mesh, mesh.cells[fit.worst_cell]);
  return {{"quality", fit.quality_min},
          {"tetrahedron", fit.worst_cell + 1},
          {"middle", vec_json(0.25 * (a + b + c + d))}};
}

void write_report(const RemeshCommand& command, const Background& background,
                  const Outcome& outcome) {
  const RemeshReport& r = outcome.remesh;
  nlohmann::ordered_json report;
  report["program"] = program_json();
  report["input"] = {{"mesh", command.mesh.string()},
                     {"metric", command.metric.string()},
                     {"tets", background.mesh.cells.size()},
                     {"nodes", background.mesh.points.size()},
                     {"complexity", complexity(background.mesh, background.metrics)}};
  report["settings"] = {{"max_tets", command.max_tets > 0 ? json(command.max_tets) : json()},
                        {"start", outcome.kept_start ? "mesh" : "box"}};
  report["mesh"] = {
      {"tets", outcome.mesh.cells.size()},
      {"nodes", outcome.mesh.points.size()},
      {"edges", outcome.fit.edges},
      {"edge_unit_fraction", outcome.fit.unit_edge_fraction},
      {"edge_length_min", outcome.fit.length_min},
      {"edge_length_max", outcome.fit.length_max},
      {"quality_min", outcome.fit.quality_min},
      {"quality_mean", outcome.fit.quality_mean},
      {"worst_cell", worst_cell_json(outcome.mesh, outcome.fit)},
      {"shortest_edge", edge_json(outcome.mesh, outcome.fit.shortest, outcome.fit.length_min)},
      {"longest_edge", edge_json(outcome.mesh, outcome.fit.longest, outcome.fit.length_max)}};
  report["remesh"] = {{"rounds", r.rounds}, {"splits", r.splits}, {"collapses", r.collapses},
                      {"swaps", r.swaps},   {"moves", r.moves},   {"size_factor", r.size_factor}};
  report["converged"] = r.converged;
  add_costs(report);
  write_json(command.report, report);
}

int run_remesh(const RemeshCommand& command, const CommonOptions& common) {
  require_output(command.output, {".mesh"}, "--output");
  if (!command.report.empty()) require_output(command.report, {".json"}, "--report");
  const Background background = read_background(command);
  const Outcome outcome = build(background, command, common.quiet);
  write_medit_mesh(command.output, outcome.mesh);
  if (!command.report.empty()) write_report(command, background, outcome);
  std::cout << outcome.mesh.cells.size() << " tetrahedra, " << outcome.mesh.points.size()
            << " vertices, " << 100 * outcome.fit.unit_edge_fraction
            << " % unit edges, quality at least " << outcome.fit.quality_min << ", on average "
            << outcome.fit.quality_mean << "\n";
  if (outcome.remesh.converged) return kExitDone;
  log_error("remesh: not converged after " + std::to_string(outcome.remesh.rounds) +
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
