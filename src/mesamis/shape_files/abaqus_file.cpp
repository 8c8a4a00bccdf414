// SPDX-License-Identifier: Apache-2.0
// Writing an Abaqus .inp of C3D4 elements, which CalculiX reads as well.
#include "mesamis/shape_files/abaqus_sections.h"
#include "mesamis/shape_files/mesh_checks.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis {

namespace {

/// C3D4: the first three nodes turn counter-clockwise seen from the fourth, as ours do.
void write_elements(TextWriter& out, const TetMesh& mesh) {
  out << "*ELEMENT, TYPE=C3D4, ELSET=ALL\n";
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    out << c + 1;
    for (const Index n : mesh.cells[c]) out << ", " << std::int64_t{n} + 1;
    out << "\n";
  }
}

/// What the user completes: which material each set is made of is not in a scan.
void write_template(TextWriter& out, const CellSets& sets,
                    std::span<const std::int64_t> cell_counts) {
  out << "** To give each set a material, define MAT_..., then take away \"** \":\n";
  for (std::size_t s = 0; s < sets.sets.size(); ++s) {
    if (cell_counts[s] == 0) continue;
    const std::string& name = sets.sets[s].name;
    out << "** *SOLID SECTION, ELSET=" << name << ", MATERIAL=MAT_" << name << "\n";
  }
}

}  // namespace

void write_abaqus(const OutputPath& path, const TetMesh& mesh, const CellSets& sets, Frame frame) {
  require_sets(path, mesh, sets);
  std::vector<std::vector<Index>> cells_of(sets.sets.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    cells_of[static_cast<std::size_t>(sets.of_cell[c])].push_back(static_cast<Index>(c));
  }
  TextWriter out(path);
  write_abaqus_head(out, frame);
  write_abaqus_nodes(out, mesh.points, frame);
  write_elements(out, mesh);
  for (std::size_t s = 0; s < cells_of.size(); ++s) {
    out << "** " << sets.sets[s].name << ": " << sets.sets[s].note << "\n";
    write_abaqus_set(out, "*ELSET, ELSET=", sets.sets[s].name, cells_of[s]);
  }
  write_template(out, sets, cells_per_set(sets));
  out.commit();
}

}  // namespace mesamis
