// SPDX-License-Identifier: Apache-2.0
// Writing an Abaqus .inp of C3D4 elements, which CalculiX reads as well.
#include "mesamis/files/text_writer.h"
#include "mesamis/shape_files/mesh_checks.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis {

using namespace detail;

namespace {

// CalculiX refuses a number of more than 20 characters.
constexpr int kDigits = 13;  // with sign, point and a three-digit exponent, 20 characters
constexpr std::size_t kEntriesPerLine = 16;

void write_head(TextWriter& out, Frame frame) {
  out << "*HEADING\nTetrahedral mesh of a scan\n"
      << "** Lengths in mm; frame " << frame_name(frame)
      << (frame == Frame::kRas ? ": x right, y front, z head\n" : ": x left, y back, z head\n");
}

void write_nodes(TextWriter& out, const TetMesh& mesh, Frame frame) {
  out << "*NODE, NSET=ALL\n";
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const Vec3 p = in_frame(mesh.points[n], frame);
    out << n + 1;
    for (int axis = 0; axis < 3; ++axis) {
      out << ", ";
      out.number(p[axis], kDigits);
    }
    out << "\n";
  }
}

/// C3D4: the first three nodes turn counter-clockwise seen from the fourth, as ours do.
void write_elements(TextWriter& out, const TetMesh& mesh) {
  out << "*ELEMENT, TYPE=C3D4, ELSET=ALL\n";
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    out << c + 1;
    for (const Index n : mesh.cells[c]) out << ", " << std::int64_t{n} + 1;
    out << "\n";
  }
}

void write_set(TextWriter& out, const CellSets::Set& set, std::span<const Index> cells) {
  out << "** " << set.name << ": " << set.note << "\n";
  if (cells.empty()) return;  // an empty set is an error for some programs
  out << "*ELSET, ELSET=" << set.name << "\n";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool line_ends = (i + 1) % kEntriesPerLine == 0 || i + 1 == cells.size();
    out << std::int64_t{cells[i]} + 1 << (line_ends ? "\n" : ", ");
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

void write_abaqus(const std::filesystem::path& path, const TetMesh& mesh, const CellSets& sets,
                  Frame frame) {
  require_sets(path, mesh, sets);
  std::vector<std::vector<Index>> cells_of(sets.sets.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    cells_of[static_cast<std::size_t>(sets.of_cell[c])].push_back(static_cast<Index>(c));
  }
  TextWriter out(path);
  write_head(out, frame);
  write_nodes(out, mesh, frame);
  write_elements(out, mesh);
  for (std::size_t s = 0; s < cells_of.size(); ++s) write_set(out, sets.sets[s], cells_of[s]);
  write_template(out, sets, cells_per_set(sets));
  out.commit();
}

}  // namespace mesamis
