// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/vtk_xml_writer.h"

/// The writer behind every .vtu.
namespace mesamis::detail::shape_files {

/// Tetrahedra as they go to a file: linear (type 10), or quadratic (type 24) where they have
/// mid-side nodes in the order of kMidNodeEdges.
struct VtuGrid {
  std::span<const Vec3> points;
  std::span<const Cell> cells;
  std::span<const std::array<Index, 6>> mid_nodes{};  ///< of each cell, or none
  std::vector<VtkArray> field_data{};                 ///< beside frame and unit
};

/// Writes the grid: whole or not at all.
/// @throws InputError  as write_vtu().
void write_vtu_grid(const OutputPath& path, const VtuGrid& grid, const VtuOptions& options);

}  // namespace mesamis::detail::shape_files
