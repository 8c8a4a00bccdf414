// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/remesh_json.h"

#include <nlohmann/json.hpp>

#include "mesamis/report/json_file.h"

namespace mesamis::detail::report {
namespace {

using nlohmann::ordered_json;

ordered_json edge_json(const TetMesh& mesh, const Edge& edge, double length) {
  return {{"length", length},
          {"vertices", {edge[0] + 1, edge[1] + 1}},
          {"middle", vec_json(0.5 * (mesh.points[edge[0]] + mesh.points[edge[1]]))}};
}

ordered_json worst_cell_json(const TetMesh& mesh, const MeshFit& fit) {
  const auto [a, b, c, d] = cell_corners(mesh, mesh.cells[fit.worst_cell]);
  return {{"quality", fit.quality_min},
          {"tetrahedron", fit.worst_cell + 1},
          {"middle", vec_json(0.25 * (a + b + c + d))}};
}

}  // namespace

ordered_json fit_json(const AdaptedMesh& adapted) {
  const auto& [mesh, kept_start, report, fit] = adapted;
  return {{"tets", mesh.cells.size()},
          {"nodes", mesh.points.size()},
          {"edges", fit.edges},
          {"edge_unit_fraction", fit.unit_edge_fraction},
          {"edge_length_min", fit.length_min},
          {"edge_length_max", fit.length_max},
          {"quality_min", fit.quality_min},
          {"quality_mean", fit.quality_mean},
          {"worst_cell", worst_cell_json(mesh, fit)},
          {"shortest_edge", edge_json(mesh, fit.shortest, fit.length_min)},
          {"longest_edge", edge_json(mesh, fit.longest, fit.length_max)}};
}

ordered_json remesh_json(const RemeshReport& report) {
  return {{"rounds", report.rounds},       {"splits", report.splits},
          {"collapses", report.collapses}, {"swaps", report.swaps},
          {"moves", report.moves},         {"size_factor", report.size_factor}};
}

}  // namespace mesamis::detail::report
