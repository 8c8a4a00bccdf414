// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/remesh_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace mesamis {
namespace {

TEST(FitJson, NamesTheWorstWhereTheyAre) {
  AdaptedMesh adapted;
  adapted.mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {2, 3, 2});
  const std::vector<Sym3> metrics(adapted.mesh.points.size(), kIdentity3);
  adapted.fit = measure_fit(adapted.mesh, metrics);
  const TetMesh& mesh = adapted.mesh;
  const auto json = fit_json(adapted);
  EXPECT_EQ(json["tets"], mesh.cells.size());
  EXPECT_EQ(json["worst_cell"]["quality"], json["quality_min"]);
  EXPECT_EQ(json["worst_cell"]["tetrahedron"], adapted.fit.worst_cell + 1) << "counted from 1";
  const auto [a, b, c, d] = cell_corners(mesh, mesh.cells[adapted.fit.worst_cell]);
  EXPECT_NEAR(json["worst_cell"]["middle"][1], (a.y + b.y + c.y + d.y) / 4, 1e-12);
  for (const char* name : {"shortest_edge", "longest_edge"}) {
    const Vec3 p = mesh.points.at(json[name]["vertices"][0].get<std::size_t>() - 1);
    const Vec3 q = mesh.points.at(json[name]["vertices"][1].get<std::size_t>() - 1);
    EXPECT_NEAR(json[name]["length"], norm(p - q), 1e-12) << "the metric is that of space";
    EXPECT_NEAR(json[name]["middle"][2], (p.z + q.z) / 2, 1e-12);
  }
  EXPECT_LT(json["edge_length_min"], json["edge_length_max"]);
}

TEST(RemeshJson, CountsTheOperations) {
  RemeshReport report;
  report.rounds = 4;
  report.swaps = 7;
  report.size_factor = 1.5;
  const auto json = remesh_json(report);
  EXPECT_EQ(json["rounds"], 4);
  EXPECT_EQ(json["swaps"], 7);
  EXPECT_EQ(json["size_factor"], 1.5);
}

}  // namespace
}  // namespace mesamis
