// SPDX-License-Identifier: Apache-2.0
// Writing a Gmsh .msh of a body with parts and sets, in the versions 2.2 and 4.1 of the format.
//
// A part is a volume and a physical group of dimension 3, both of number part + 1. A set of faces
// is a surface and a physical group of dimension 2, both of number parts + set + 1. A face of two
// sets is written twice.
#include <algorithm>

#include "mesamis/shape_files/element_formats.h"
#include "mesamis/shape_files/gmsh_sections.h"
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis::detail::shape_files {
namespace {

// Gmsh's numbers of its types of elements.
constexpr int kTriangle3 = 2, kTetrahedron4 = 4, kTriangle6 = 9, kTetrahedron10 = 11;

class Writer {
 public:
  Writer(const OutputPath& path, const FiniteElements& elements, const ElementWriteOptions& options)
      : out_(path),
        e_(elements),
        options_(options),
        cells_(cells_by_group(elements.part_of_cell, elements.parts.size())),
        quadratic_(!elements.mid_nodes.empty()) {}

  void write() {
    const bool old = options_.gmsh == GmshVersion::k22;
    out_ << "$MeshFormat\n" << (old ? "2.2" : "4.1") << " 0 8\n$EndMeshFormat\n";
    write_names();
    old ? write_version_2() : write_version_4();
    for (const MeshArray& array : options_.point_arrays) write_gmsh_data(out_, "NodeData", array);
    if (!old || count_faces() == 0) {
      for (const MeshArray& array : material_arrays(e_)) write_element_data(array);
      for (const MeshArray& array : options_.cell_arrays) write_element_data(array);
    }
    write_comments();
    out_.commit();
  }

 private:
  /// A value for every element of the file, in its order, as meshio expects, which goes by their
  /// place: a face of a set has that of its cell. Of version 2.2 meshio cannot read data beside
  /// elements of two types (its issue 1257): there, with sets, write() leaves them out.
  void write_element_data(MeshArray array) {
    std::vector<std::size_t> order;
    if (options_.gmsh == GmshVersion::k41) {
      for (const auto& cells : cells_) order.insert(order.end(), cells.begin(), cells.end());
    }
    for (const auto& set : e_.sets) {
      for (const auto& face : set.faces) {
        if (!order.empty()) order.push_back(array.values.size());
        array.values.push_back(array.values[static_cast<std::size_t>(face[0])]);
      }
    }
    write_gmsh_data(out_, "ElementData", array, order);
  }

  std::size_t surface_number(std::size_t set) const { return e_.parts.size() + set + 1; }

  std::size_t count_parts() const {
    return static_cast<std::size_t>(
        std::count_if(cells_.begin(), cells_.end(), [](const auto& c) { return !c.empty(); }));
  }
  std::size_t count_surfaces() const {
    return static_cast<std::size_t>(std::count_if(
        e_.sets.begin(), e_.sets.end(), [](const auto& set) { return !set.faces.empty(); }));
  }
  std::size_t count_faces() const {
    std::size_t count = 0;
    for (const auto& set : e_.sets) count += set.faces.size();
    return count;
  }

  /// Parts and sets without elements have no group.
  void write_names() {
    out_ << "$PhysicalNames\n" << count_parts() + count_surfaces() << "\n";
    for (std::size_t s = 0; s < e_.sets.size(); ++s) {
      if (e_.sets[s].faces.empty()) continue;
      out_ << "2 " << surface_number(s) << " \"" << e_.sets[s].name << "\"\n";
    }
    for (std::size_t p = 0; p < cells_.size(); ++p) {
      if (!cells_[p].empty()) out_ << "3 " << p + 1 << " \"" << e_.parts[p].name << "\"\n";
    }
    out_ << "$EndPhysicalNames\n";
  }

  /// The rest of an element's line.
  void write_cell_nodes(std::size_t c) {
    for (const Index n : e_.cells[c]) out_ << " " << std::int64_t{n} + 1;
    if (quadratic_) {
      for (const std::size_t m : {0, 1, 2, 3, 5, 4}) {  // Gmsh swaps the last two
        out_ << " " << std::int64_t{e_.mid_nodes[c][m]} + 1;
      }
    }
    out_ << "\n";
  }
  void write_face_nodes(const std::array<Index, 2>& face) {
    const auto nodes = face_nodes(e_, face[0], face[1]);
    for (const Index n : std::span(nodes).first(quadratic_ ? 6 : 3)) {
      out_ << " " << std::int64_t{n} + 1;
    }
    out_ << "\n";
  }

  int cell_type() const { return quadratic_ ? kTetrahedron10 : kTetrahedron4; }
  int face_type() const { return quadratic_ ? kTriangle6 : kTriangle3; }

  void write_version_2() {
    write_gmsh_nodes(out_, e_.points, options_.frame);
    out_ << "$Elements\n" << e_.cells.size() + count_faces() << "\n";
    for (std::size_t c = 0; c < e_.cells.size(); ++c) {
      const auto part = std::int64_t{e_.part_of_cell[c]} + 1;
      out_ << c + 1 << " " << cell_type() << " 2 " << part << " " << part;
      write_cell_nodes(c);
    }
    std::size_t number = e_.cells.size();
    for (std::size_t s = 0; s < e_.sets.size(); ++s) {
      for (const auto& face : e_.sets[s].faces) {
        out_ << ++number << " " << face_type() << " 2 " << surface_number(s) << " "
             << surface_number(s);
        write_face_nodes(face);
      }
    }
    out_ << "$EndElements\n";
  }

  void write_version_4() {
    write_entities();
    write_nodes_4();
    write_elements_4();
  }

  /// A surface or a volume with its box, its group and no boundary.
  void write_entity(std::size_t number, const Box& box) {
    out_ << number;
    for (const Vec3& corner : {box.lo, box.hi}) {
      for (int axis = 0; axis < 3; ++axis) {
        out_ << " ";
        out_.number(corner[axis]);
      }
    }
    out_ << " 1 " << number << " 0\n";
  }

  void write_entities() {
    std::vector<Vec3> points;
    for (const Vec3& p : e_.points) points.push_back(in_frame(p, options_.frame));
    const Box box = bounding_box(points);
    out_ << "$Entities\n0 0 " << count_surfaces() << " " << count_parts() << "\n";
    for (std::size_t s = 0; s < e_.sets.size(); ++s) {
      if (!e_.sets[s].faces.empty()) write_entity(surface_number(s), box);
    }
    for (std::size_t p = 0; p < cells_.size(); ++p) {
      if (!cells_[p].empty()) write_entity(p + 1, box);
    }
    out_ << "$EndEntities\n";
  }

  /// All nodes in one block: that of the first part.
  void write_nodes_4() {
    const std::size_t count = e_.points.size();
    const auto part = *std::min_element(e_.part_of_cell.begin(), e_.part_of_cell.end()) + 1;
    out_ << "$Nodes\n1 " << count << " 1 " << count << "\n3 " << part << " 0 " << count << "\n";
    for (std::size_t n = 0; n < count; ++n) out_ << n + 1 << "\n";
    for (const Vec3& p : e_.points) write_gmsh_point(out_, in_frame(p, options_.frame));
    out_ << "$EndNodes\n";
  }

  void write_elements_4() {
    const std::size_t count = e_.cells.size() + count_faces();
    out_ << "$Elements\n"
         << count_parts() + count_surfaces() << " " << count << " 1 " << count << "\n";
    for (std::size_t p = 0; p < cells_.size(); ++p) {
      if (cells_[p].empty()) continue;
      out_ << "3 " << p + 1 << " " << cell_type() << " " << cells_[p].size() << "\n";
      for (const Index c : cells_[p]) {
        out_ << std::int64_t{c} + 1;
        write_cell_nodes(static_cast<std::size_t>(c));
      }
    }
    std::size_t number = e_.cells.size();
    for (std::size_t s = 0; s < e_.sets.size(); ++s) {
      const auto& faces = e_.sets[s].faces;
      if (faces.empty()) continue;
      out_ << "2 " << surface_number(s) << " " << face_type() << " " << faces.size() << "\n";
      for (const auto& face : faces) {
        out_ << ++number;
        write_face_nodes(face);
      }
    }
    out_ << "$EndElements\n";
  }

  /// Last, where readers that know few sections have stopped reading.
  void write_comments() {
    out_ << "$Comments\nSPACE=" << frame_name(options_.frame) << " LengthUnit=mm\n";
    for (const auto& part : e_.parts) out_ << part.name << ": " << one_line(part.note) << "\n";
    for (const auto& material : e_.materials) {
      out_ << material.name << ": " << material.modulus << " MPa, " << material.poisson << ", "
           << material.density << " g/cm^3\n";
    }
    out_ << "$EndComments\n";
  }

  TextWriter out_;
  const FiniteElements& e_;
  const ElementWriteOptions& options_;
  std::vector<std::vector<Index>> cells_;  // of each part
  bool quadratic_;
};

}  // namespace

void write_gmsh_elements(const OutputPath& path, const FiniteElements& elements,
                         const ElementWriteOptions& options) {
  require_gmsh_scalars(path, options.point_arrays, elements.points.size());
  require_gmsh_scalars(path, options.cell_arrays, elements.cells.size());
  Writer(path, elements, options).write();
}

}  // namespace mesamis::detail::shape_files
