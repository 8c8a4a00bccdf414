// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <vector>

#include "mesamis/shape_files/mesh_files.h"
#include "support/perturbed_box.h"

/// What the tests of the finite element formats share.
namespace mesamis {

/// A mesh with one array of points and of cells, and three sets of which one is empty.
struct FiniteElementExample {
  MeshWithArrays grid{perturbed_box({{0, 0, 0}, {4, 5, 600}}, {3, 2, 4}, 0.2), {}, {}};
  CellSets sets{{{"LOW", "dark"}, {"EMPTY", "nothing"}, {"HIGH", "bright"}}, {}};

  FiniteElementExample() {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 1000);
    MeshArray u{"u", 1, {}}, native{"native", 1, {}};
    for (std::size_t n = 0; n < grid.mesh.points.size(); ++n) u.values.push_back(normal(random));
    for (std::size_t c = 0; c < grid.mesh.cells.size(); ++c) {
      native.values.push_back(normal(random));
      sets.of_cell.push_back(random() % 2 ? 2 : 0);
    }
    grid.point_arrays = {u};
    grid.cell_arrays = {native};
    grid.mesh.points[0] = {-1.23456789012345678e-5, 1e-3 / 3, -1.0e-101 / 7};
  }
};

/// What a parser finds, by the file's own numbers.
struct FileContents {
  std::map<int, Vec3> nodes;
  std::map<int, std::vector<int>> elements, sets;
  std::map<int, std::string> set_names;
  std::map<std::string, std::map<int, double>> node_data, element_data;
};

inline void expect_cells(const FileContents& found, const TetMesh& mesh) {
  ASSERT_EQ(found.nodes.size(), mesh.points.size());
  ASSERT_EQ(found.elements.size(), mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& corners = found.elements.at(static_cast<int>(c) + 1);
    ASSERT_EQ(corners.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(corners[i], mesh.cells[c][i] + 1);
  }
}

inline void expect_set(const std::vector<int>& numbers, const FiniteElementExample& example,
                       Index set) {
  std::vector<int> expected;
  for (std::size_t c = 0; c < example.sets.of_cell.size(); ++c) {
    if (example.sets.of_cell[c] == set) expected.push_back(static_cast<int>(c) + 1);
  }
  EXPECT_EQ(numbers, expected);
}

}  // namespace mesamis
