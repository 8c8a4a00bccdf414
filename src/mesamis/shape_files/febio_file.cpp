// SPDX-License-Identifier: Apache-2.0
// Writing a FEBio .feb, version 4.0 of the format.
#include <map>

#include "mesamis/files/text_writer.h"
#include "mesamis/shape_files/element_formats.h"

namespace mesamis::detail::shape_files {
namespace {

constexpr double kTonnePerMm3 = 1e-9;  // of 1 g/cm^3

/// Elements of one part and one material, as FEBio takes them.
struct Domain {
  std::string name;
  Index material = kNoIndex;
  std::vector<Index> cells;
};

/// A domain per part and material that have elements in common, parts first. A name has a hyphen
/// only here, so that it is no other name.
std::vector<Domain> domains_of(const FiniteElements& e) {
  std::map<std::array<Index, 2>, std::vector<Index>> cells;
  for (std::size_t c = 0; c < e.cells.size(); ++c) {
    const Index material = e.materials.empty() ? kNoIndex : e.material_of_cell[c];
    cells[{e.part_of_cell[c], material}].push_back(static_cast<Index>(c));
  }
  std::vector<Domain> domains;
  for (auto& [key, of_domain] : cells) {
    const auto [part, material] = key;
    std::string name = e.parts[static_cast<std::size_t>(part)].name;
    if (material != kNoIndex) name += "-" + e.materials[static_cast<std::size_t>(material)].name;
    domains.push_back({name, material, std::move(of_domain)});
  }
  return domains;
}

void write_materials(TextWriter& out, const FiniteElements& e) {
  if (e.materials.empty()) return;
  out << "  <Material>\n";
  for (std::size_t m = 0; m < e.materials.size(); ++m) {
    const auto& material = e.materials[m];
    out << "    <material id=\"" << m + 1 << "\" name=\"" << material.name
        << "\" type=\"isotropic elastic\">";
    if (material.density > 0) out << "<density>" << kTonnePerMm3 * material.density << "</density>";
    out << "<E>" << material.modulus << "</E><v>" << material.poisson << "</v></material>\n";
  }
  out << "  </Material>\n";
}

void write_nodes(TextWriter& out, std::span<const Vec3> points, Frame frame) {
  out << "    <Nodes name=\"ALL\">\n";
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3 p = in_frame(points[n], frame);
    out << "      <node id=\"" << n + 1 << "\">";
    for (int axis = 0; axis < 3; ++axis) {
      if (axis > 0) out << ",";
      out.number(p[axis]);
    }
    out << "</node>\n";
  }
  out << "    </Nodes>\n";
}

/// Numbers from 1, separated by commas.
void write_list(TextWriter& out, std::span<const Index> items) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out << ",";
    out << std::int64_t{items[i]} + 1;
  }
}

void write_domain(TextWriter& out, const FiniteElements& e, const Domain& domain) {
  const bool quadratic = !e.mid_nodes.empty();
  out << "    <Elements type=\"" << (quadratic ? "tet10" : "tet4") << "\" name=\"" << domain.name
      << "\">\n";
  for (const Index cell : domain.cells) {
    const auto c = static_cast<std::size_t>(cell);
    out << "      <elem id=\"" << c + 1 << "\">";
    write_list(out, e.cells[c]);
    if (quadratic) {
      out << ",";
      write_list(out, e.mid_nodes[c]);
    }
    out << "</elem>\n";
  }
  out << "    </Elements>\n";
}

void write_surface(TextWriter& out, const FiniteElements& e, const FiniteElements::FaceSet& set) {
  const std::size_t nodes = e.mid_nodes.empty() ? 3 : 6;
  const char* tag = e.mid_nodes.empty() ? "tri3" : "tri6";
  out << "    <Surface name=\"" << set.name << "\">\n";
  for (std::size_t f = 0; f < set.faces.size(); ++f) {
    const auto face = face_nodes(e, set.faces[f][0], set.faces[f][1]);
    out << "      <" << tag << " id=\"" << f + 1 << "\">";
    write_list(out, std::span(face).first(nodes));
    out << "</" << tag << ">\n";
  }
  out << "    </Surface>\n";
}

void write_sets(TextWriter& out, const FiniteElements& e) {
  for (const auto& set : e.sets) {
    if (!set.nodes.empty()) {
      out << "    <NodeSet name=\"" << set.name << "\">";
      write_list(out, set.nodes);
      out << "</NodeSet>\n";
    }
    if (!set.faces.empty()) write_surface(out, e, set);
  }
}

/// The parts, where their domains do not have their names.
void write_element_sets(TextWriter& out, const FiniteElements& e) {
  if (e.materials.empty()) return;
  const auto cells = cells_by_group(e.part_of_cell, e.parts.size());
  for (std::size_t p = 0; p < cells.size(); ++p) {
    if (cells[p].empty()) continue;
    out << "    <ElementSet name=\"" << e.parts[p].name << "\">";
    write_list(out, cells[p]);
    out << "</ElementSet>\n";
  }
}

void write_mesh_domains(TextWriter& out, const FiniteElements& e,
                        const std::vector<Domain>& domains) {
  if (e.materials.empty()) {
    out << "  <!-- Nothing is known of the materials: add Material and MeshDomains. -->\n";
    return;
  }
  out << "  <MeshDomains>\n";
  for (const Domain& domain : domains) {
    out << "    <SolidDomain name=\"" << domain.name << "\" mat=\""
        << e.materials[static_cast<std::size_t>(domain.material)].name << "\"/>\n";
  }
  out << "  </MeshDomains>\n";
}

}  // namespace

void write_febio(const OutputPath& path, const FiniteElements& elements,
                 const ElementWriteOptions& options) {
  const std::vector<Domain> domains = domains_of(elements);
  TextWriter out(path);
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n"
      << "  <!-- mesamis, SPACE=" << frame_name(options.frame)
      << ", lengths in mm, moduli in MPa, densities in tonne/mm^3 -->\n"
      << "  <Module type=\"solid\"/>\n";
  write_materials(out, elements);
  out << "  <Mesh>\n";
  write_nodes(out, elements.points, options.frame);
  for (const Domain& domain : domains) write_domain(out, elements, domain);
  write_element_sets(out, elements);
  write_sets(out, elements);
  out << "  </Mesh>\n";
  write_mesh_domains(out, elements, domains);
  out << "</febio_spec>\n";
  out.commit();
}

}  // namespace mesamis::detail::shape_files
