// SPDX-License-Identifier: Apache-2.0
// Writing a Gmsh .msh in the format's version 2.2, ASCII.
#include <algorithm>

#include "mesamis/shape_files/gmsh_sections.h"
#include "mesamis/shape_files/mesh_checks.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis {

namespace {

constexpr int kTetrahedron = 4;  // Gmsh's number for this type of element

void write_names(TextWriter& out, const CellSets& sets) {
  const auto counts = cells_per_set(sets);
  const auto used = counts.size() - static_cast<std::size_t>(
                                        std::count(counts.begin(), counts.end(), std::int64_t{0}));
  out << "$PhysicalNames\n" << used << "\n";
  for (std::size_t s = 0; s < counts.size(); ++s) {
    if (counts[s] > 0) out << "3 " << s + 1 << " \"" << sets.sets[s].name << "\"\n";
  }
  out << "$EndPhysicalNames\n";
}

/// The geometric entity, the second tag, is the set as well: no entity lies in two groups.
void write_elements(TextWriter& out, const TetMesh& mesh, const CellSets& sets) {
  out << "$Elements\n" << mesh.cells.size() << "\n";
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto set = sets.of_cell[c] + 1;
    out << c + 1 << " " << kTetrahedron << " 2 " << set << " " << set;
    for (const Index n : mesh.cells[c]) out << " " << std::int64_t{n} + 1;
    out << "\n";
  }
  out << "$EndElements\n";
}

/// Last, where readers that know few sections have stopped reading.
void write_comments(TextWriter& out, const CellSets& sets, Frame frame) {
  out << "$Comments\nSPACE=" << frame_name(frame) << " LengthUnit=mm\n";
  for (const auto& set : sets.sets) out << set.name << ": " << set.note << "\n";
  out << "$EndComments\n";
}

}  // namespace

void write_gmsh(const OutputPath& path, const MeshWithArrays& grid, const CellSets& sets,
                Frame frame) {
  require_sets(path, grid.mesh, sets);
  require_gmsh_scalars(path, grid.point_arrays, grid.mesh.points.size());
  require_gmsh_scalars(path, grid.cell_arrays, grid.mesh.cells.size());
  TextWriter out(path);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  write_names(out, sets);
  write_gmsh_nodes(out, grid.mesh.points, frame);
  write_elements(out, grid.mesh, sets);
  for (const MeshArray& array : grid.point_arrays) write_gmsh_data(out, "NodeData", array);
  for (const MeshArray& array : grid.cell_arrays) write_gmsh_data(out, "ElementData", array);
  write_comments(out, sets, frame);
  out.commit();
}

}  // namespace mesamis
