// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

/// The edge of each mid-side node of a quadratic tetrahedron: the order of Abaqus, VTK and FEBio.
/// Gmsh swaps the last two.
inline constexpr std::array<std::array<int, 2>, 6> kMidNodeEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

inline constexpr std::size_t kLongestSolverName = 60;

/// Whether solvers accept a text as a name: letters, digits and underscores, of which the first is
/// a letter, at most 60.
inline bool is_solver_name(std::string_view name) noexcept {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto may_follow = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name.size() <= kLongestSolverName && is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(), may_follow);
}

/// A body of tetrahedra as a solver for finite elements takes it: parts, materials, and sets of
/// faces and nodes for supports and loads. Names have letters, digits and underscores, begin with a
/// letter, have at most 60 characters, differ from each other in more than case, and none is ALL.
struct FiniteElements {
  std::vector<Vec3> points;  ///< LPS mm; corners first, then mid-side nodes
  std::vector<Cell> cells;   ///< corners, of positive orientation
  /// The mid-side nodes of each cell, see kMidNodeEdges; empty: linear elements.
  std::vector<std::array<Index, 6>> mid_nodes{};

  /// An object or a label.
  struct Part {
    std::string name;
    std::string note{};  ///< one line that goes into comments
  };
  std::vector<Part> parts;          ///< at least one
  std::vector<Index> part_of_cell;  ///< per cell its part

  /// An isotropic linear elastic material.
  struct Elastic {
    std::string name;
    double modulus = 0;  ///< MPa, > 0
    double poisson = 0;  ///< no unit, above -1 and below 0.5
    double density = 0;  ///< g/cm^3, >= 0; 0: not stated in the file
  };
  std::vector<Elastic> materials{};       ///< empty, as the next: none
  std::vector<Index> material_of_cell{};  ///< per cell its material

  /// Faces and nodes under one name.
  struct FaceSet {
    std::string name;
    std::vector<std::array<Index, 2>> faces{};  ///< a cell, and the local vertex opposite the face
    std::vector<Index> nodes{};                 ///< mid-side nodes too; each once
  };
  std::vector<FaceSet> sets{};
};

/// The three corners of a face, then the nodes between the first and the second, the second and the
/// third, the third and the first; these are kNoIndex for linear elements. The face turns
/// counter-clockwise seen from outside.
/// @param cell    an index in range.
/// @param vertex  0 to 3, opposite the face.
inline std::array<Index, 6> face_nodes(const FiniteElements& elements, Index cell,
                                       int vertex) noexcept {
  const auto c = static_cast<std::size_t>(cell);
  const auto& face = kCellFaces[static_cast<std::size_t>(vertex)];
  std::array<Index, 6> nodes;
  for (std::size_t i = 0; i < 3; ++i) {
    const int a = face[i], b = face[(i + 1) % 3];
    nodes[i] = elements.cells[c][static_cast<std::size_t>(a)];
    nodes[i + 3] = kNoIndex;
    if (elements.mid_nodes.empty()) continue;
    for (std::size_t e = 0; e < kMidNodeEdges.size(); ++e) {
      const auto [from, to] = kMidNodeEdges[e];
      const bool is_edge = (from == a && to == b) || (from == b && to == a);
      if (is_edge) nodes[i + 3] = elements.mid_nodes[c][e];
    }
  }
  return nodes;
}

}  // namespace mesamis
