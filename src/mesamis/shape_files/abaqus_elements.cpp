// SPDX-License-Identifier: Apache-2.0
// Writing an Abaqus .inp of a body with parts, materials and sets: CalculiX runs it once a *STEP is
// appended.
#include <algorithm>

#include "mesamis/base/each_once.h"
#include "mesamis/shape_files/abaqus_sections.h"
#include "mesamis/shape_files/element_formats.h"
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis::detail::shape_files {
namespace {

constexpr double kTonnePerMm3 = 1e-9;  // of 1 g/cm^3: the unit of mass that goes with N, mm and s

// Abaqus names a face by its nodes: S1 = 1 2 3, S2 = 1 4 2, S3 = 2 4 3, S4 = 3 4 1.
constexpr std::array kFaceOpposite{"S3", "S4", "S2", "S1"};  // the vertex of this place

void write_connectivity(TextWriter& out, const FiniteElements& e) {
  const bool quadratic = !e.mid_nodes.empty();
  out << "*ELEMENT, TYPE=" << (quadratic ? "C3D10" : "C3D4") << ", ELSET=ALL\n";
  for (std::size_t c = 0; c < e.cells.size(); ++c) {
    out << c + 1;
    for (const Index n : e.cells[c]) out << ", " << std::int64_t{n} + 1;
    if (quadratic) {
      for (const Index n : e.mid_nodes[c]) out << ", " << std::int64_t{n} + 1;
    }
    out << "\n";
  }
}

/// The nodes of some cells, in increasing order.
std::vector<Index> nodes_of(const FiniteElements& e, const std::vector<Index>& cells) {
  std::vector<Index> nodes;
  for (const Index cell : cells) {
    const auto c = static_cast<std::size_t>(cell);
    nodes.insert(nodes.end(), e.cells[c].begin(), e.cells[c].end());
    if (e.mid_nodes.empty()) continue;
    nodes.insert(nodes.end(), e.mid_nodes[c].begin(), e.mid_nodes[c].end());
  }
  sort_once(nodes);
  return nodes;
}

void write_parts(TextWriter& out, const FiniteElements& e) {
  const auto cells = cells_by_group(e.part_of_cell, e.parts.size());
  for (std::size_t p = 0; p < cells.size(); ++p) {
    const auto& [name, note] = e.parts[p];
    out << "** Part " << name << (note.empty() ? "" : ": ") << one_line(note) << "\n";
    write_abaqus_set(out, "*ELSET, ELSET=", name, cells[p]);
    write_abaqus_set(out, "*NSET, NSET=", name, nodes_of(e, cells[p]));
  }
}

void write_material(TextWriter& out, const FiniteElements::Elastic& material) {
  out << "*MATERIAL, NAME=" << material.name << "\n*ELASTIC\n";
  out.number(material.modulus, kAbaqusDigits);
  out << ", ";
  out.number(material.poisson, kAbaqusDigits);
  out << "\n";
  if (material.density == 0) return;
  out << "*DENSITY\n";
  out.number(kTonnePerMm3 * material.density, kAbaqusDigits);
  out << ",\n";
}

/// A material without elements is left out.
void write_materials(TextWriter& out, const FiniteElements& e) {
  const auto cells = cells_by_group(e.material_of_cell, e.materials.size());
  if (!cells.empty()) out << "** Moduli in MPa, densities in tonne/mm^3\n";
  for (std::size_t m = 0; m < cells.size(); ++m) {
    if (cells[m].empty()) continue;
    const std::string& name = e.materials[m].name;
    write_abaqus_set(out, "*ELSET, ELSET=", name, cells[m]);
    write_material(out, e.materials[m]);
    out << "*SOLID SECTION, ELSET=" << name << ", MATERIAL=" << name << "\n";
  }
}

/// What the user completes where nothing is known of the materials.
void write_template(TextWriter& out, const FiniteElements& e) {
  out << "** To give each part a material, define MAT_..., then take away \"** \":\n";
  for (const auto& part : e.parts) {
    out << "** *SOLID SECTION, ELSET=" << part.name << ", MATERIAL=MAT_" << part.name << "\n";
  }
}

void write_face_set(TextWriter& out, const FiniteElements::FaceSet& set) {
  write_abaqus_set(out, "*NSET, NSET=", set.name, set.nodes);
  if (set.faces.empty()) return;
  out << "*SURFACE, NAME=" << set.name << ", TYPE=ELEMENT\n";
  for (const auto& [cell, vertex] : set.faces) {
    out << std::int64_t{cell} + 1 << ", " << kFaceOpposite[static_cast<std::size_t>(vertex)]
        << "\n";
  }
}

}  // namespace

void write_abaqus_elements(const OutputPath& path, const FiniteElements& elements,
                           const ElementWriteOptions& options) {
  TextWriter out(path);
  write_abaqus_head(out, options.frame);
  write_abaqus_nodes(out, elements.points, options.frame);
  write_connectivity(out, elements);
  write_parts(out, elements);
  write_materials(out, elements);
  if (elements.materials.empty()) write_template(out, elements);
  for (const auto& set : elements.sets) write_face_set(out, set);
  out.commit();
}

}  // namespace mesamis::detail::shape_files
