// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "mesamis/fem/functional.h"
#include "mesamis/mesh/tet_mesh.h"
#include "support/test_data.h"

namespace mesamis {

/// Numbers of an independent implementation of the method on a small mesh (optional data).
inline std::filesystem::path oracle_path() { return test_data("reference/amis_oracle.json"); }

inline nlohmann::json read_oracle() {
  std::ifstream in(oracle_path());
  return nlohmann::json::parse(in);
}

inline TetMesh oracle_mesh(const nlohmann::json& oracle) {
  TetMesh mesh;
  for (const auto& p : oracle["nodes"]) mesh.points.push_back({p[0], p[1], p[2]});
  for (const auto& t : oracle["tets"]) {
    Cell cell{t[0], t[1], t[2], t[3]};
    // The other implementation does not care for orientation; ours wants it positive.
    if (six_volume(mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]],
                   mesh.points[cell[3]]) < 0) {
      std::swap(cell[2], cell[3]);
    }
    mesh.cells.push_back(cell);
  }
  return mesh;
}

inline AtParameters oracle_parameters(const nlohmann::json& c) {
  const auto& p = c["parameters"];
  return {p["eps"], p["eta"], p["beta"], p["gamma"]};
}

/// Largest difference, relative to the largest expected value.
inline double relative_difference(const std::vector<double>& found,
                                  const std::vector<double>& expected) {
  double difference = found.size() == expected.size() ? 0 : 1e300, scale = 0;
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
    difference = std::max(difference, std::abs(found[i] - expected[i]));
    scale = std::max(scale, std::abs(expected[i]));
  }
  return difference / scale;
}

}  // namespace mesamis
