// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::fit {

/// Of each triangle the materials, or the parts, behind and in front of it.
using Sides = std::span<const std::array<Index, 2>>;

/// How many materials there are, up to the greatest.
std::size_t material_count(Sides sides);

/// Adds what a function tells of each triangle to the material behind it, and times `in_front` to
/// the one in front.
template <class Function>
std::vector<double> sums_of_materials(Sides sides, double in_front, Function&& function) {
  std::vector<double> sums(material_count(sides), 0);
  for (std::size_t t = 0; t < sides.size(); ++t) {
    const double value = function(t);
    if (sides[t][0] >= 0) sums[static_cast<std::size_t>(sides[t][0])] += value;
    if (sides[t][1] >= 0) sums[static_cast<std::size_t>(sides[t][1])] += in_front * value;
  }
  return sums;
}

/// The connected parts of the boundaries of each object, outer ones and those of cavities, as if each
/// were an object of its own.
struct BoundaryParts {
  std::vector<std::array<Index, 2>>
      sides;                    ///< of each triangle the parts behind and in front of it
  std::vector<Index> material;  ///< of each part; that of part 0 is 0
  std::vector<double> volumes;  ///< of each part, mm^3; of cavities negative

  /// Changes the volumes such that those of each material add up to what is told of it.
  void scale_to(std::span<const double> of_materials);
};

/// Finds the parts of boundaries. Part 0 is material 0, all of it.
/// @param sides  of each triangle: materials behind, in front.
///
/// O(n) for n triangles.
BoundaryParts parts_of_boundaries(const TriMesh& surface, Sides sides);

/// The volume that the boundary of each material encloses.
/// @return mm^3; that of material 0 has no meaning.
std::vector<double> enclosed_volumes(const TriMesh& surface, Sides sides);

}  // namespace mesamis::detail::fit
