// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "mesamis/mesh/finite_elements.h"
#include "support/perturbed_box.h"

/// What the tests of element_files.h share.
namespace mesamis {

/// Adds a node in the middle of each edge.
inline void make_quadratic(FiniteElements& e) {
  std::map<std::array<Index, 2>, Index> middle_of;
  e.mid_nodes.resize(e.cells.size());
  for (std::size_t c = 0; c < e.cells.size(); ++c) {
    for (std::size_t m = 0; m < 6; ++m) {
      const Index a = e.cells[c][static_cast<std::size_t>(kMidNodeEdges[m][0])];
      const Index b = e.cells[c][static_cast<std::size_t>(kMidNodeEdges[m][1])];
      const auto [found, is_new] = middle_of.try_emplace({std::min(a, b), std::max(a, b)},
                                                         static_cast<Index>(e.points.size()));
      if (is_new) {
        const Vec3 p = e.points[static_cast<std::size_t>(a)];
        e.points.push_back(0.5 * (p + e.points[static_cast<std::size_t>(b)]));
      }
      e.mid_nodes[c][m] = found->second;
    }
  }
}

/// The faces and nodes in the plane where a coordinate has a value.
inline FiniteElements::FaceSet plane_set(const FiniteElements& e, const std::string& name, int axis,
                                         double at) {
  FiniteElements::FaceSet set{name};
  const auto lies_there = [&](Index n) {
    return std::abs(e.points[static_cast<std::size_t>(n)][axis] - at) < 1e-9;
  };
  for (Index n = 0; n < std::ssize(e.points); ++n) {
    if (lies_there(n)) set.nodes.push_back(n);
  }
  for (Index c = 0; c < std::ssize(e.cells); ++c) {
    for (int vertex = 0; vertex < 4; ++vertex) {
      const auto face = face_nodes(e, c, vertex);
      if (std::all_of(face.begin(), face.begin() + 3, lies_there)) set.faces.push_back({c, vertex});
    }
  }
  return set;
}

/// Even permutations, which keep the orientation, and bring each vertex to each place.
inline void permute_vertices(std::vector<Cell>& cells) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Cell from = cells[c];
    for (std::size_t i = 0; i < 4; ++i) cells[c][i] = from[i ^ ((c / 6 + c) % 4)];
  }
}

/// A box of one part and one material, with a set for each of its sides.
inline FiniteElements box_elements(const Box& box, const std::array<Index, 3>& n, bool quadratic) {
  FiniteElements e;
  TetMesh mesh = perturbed_box(box, n, 0.2);
  e.points = std::move(mesh.points);
  e.cells = std::move(mesh.cells);
  permute_vertices(e.cells);
  if (quadratic) make_quadratic(e);
  e.parts = {{"BONE", "all of it"}};
  e.part_of_cell.assign(e.cells.size(), 0);
  e.materials = {{"MAT_001", 1234.5, 0.3, 1.8}};
  e.material_of_cell = e.part_of_cell;
  const std::array<const char*, 6> names{"LEFT", "RIGHT", "FRONT", "BACK", "BOTTOM", "TOP"};
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const double at = (side % 2 ? box.hi : box.lo)[axis];
    e.sets.push_back(plane_set(e, names[static_cast<std::size_t>(side)], axis, at));
  }
  return e;
}

/// Two elements of different parts and materials that share a face, a part without elements, and
/// the set of one face.
inline FiniteElements two_elements(bool quadratic) {
  FiniteElements e;
  e.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 2, 2.5}};
  e.cells = {{0, 1, 2, 3}, {1, 4, 2, 3}};
  if (quadratic) make_quadratic(e);
  e.parts = {{"HEAD", "near"}, {"NECK", ""}, {"SHAFT", "far"}};
  e.part_of_cell = {0, 2};
  e.materials = {{"STIFF", 17000, 0.3, 1.9}, {"SOFT", 350.5, 0.25, 0}};
  e.material_of_cell = {0, 1};
  FiniteElements::FaceSet floor{"FLOOR", {{0, 3}}, {0, 1, 2}};
  if (quadratic) floor.nodes.insert(floor.nodes.end(), {5, 6, 7});
  e.sets = {floor};
  return e;
}

/// The nodes behind the corners lie in the middle of the edges that the format names there.
template <std::size_t Count>
void expect_middles(const std::vector<Vec3>& nodes, std::size_t corners,
                    const std::array<std::array<int, 2>, Count>& edges) {
  ASSERT_EQ(nodes.size(), corners + Count);
  for (std::size_t m = 0; m < Count; ++m) {
    const Vec3 a = nodes[static_cast<std::size_t>(edges[m][0])];
    const Vec3 b = nodes[static_cast<std::size_t>(edges[m][1])];
    EXPECT_LT(norm(nodes[corners + m] - 0.5 * (a + b)), 1e-12) << m;
  }
}

/// The points of these numbers, which start with 1.
inline std::vector<Vec3> points_of(const std::vector<Vec3>& points,
                                   const std::vector<int>& numbers) {
  std::vector<Vec3> found;
  for (const int n : numbers) found.push_back(points.at(static_cast<std::size_t>(n) - 1));
  return found;
}

}  // namespace mesamis
