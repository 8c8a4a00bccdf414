// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/element_files.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/element_formats.h"
#include "mesamis/shape_files/surface_formats.h"
#include "mesamis/shape_files/vtu_writer.h"

namespace mesamis::detail::shape_files {

namespace {

/// What a body must hold, each check in one line.
class Checks {
 public:
  Checks(const std::filesystem::path& path, const FiniteElements& elements)
      : path_(path), e_(elements) {}

  void run() const {
    if (e_.cells.empty()) refuse(path_, "a mesh without cells cannot be written");
    require_groups(e_.part_of_cell, e_.parts.size(), "part");
    if (!e_.materials.empty() || !e_.material_of_cell.empty()) {
      require_groups(e_.material_of_cell, e_.materials.size(), "material");
    }
    for (const Cell& cell : e_.cells) require_points(cell, "a cell");
    if (!e_.mid_nodes.empty()) require_size(e_.mid_nodes.size(), "six mid-side nodes");
    for (const auto& nodes : e_.mid_nodes) require_points(nodes, "a cell");
    for (const auto& material : e_.materials) require_material(material);
    for (const auto& set : e_.sets) require_set(set);
    for (const Vec3& p : e_.points) require_finite(p);
    require_names();
  }

 private:
  void require_size(std::size_t size, const char* what) const {
    if (size == e_.cells.size()) return;
    refuse(path_,
           message("expected ", what, " for each of ", e_.cells.size(), " cells, found ", size));
  }

  void require_groups(const std::vector<Index>& of_cell, std::size_t count,
                      const std::string& what) const {
    require_size(of_cell.size(), ("a " + what).c_str());
    for (const Index group : of_cell) {
      if (group >= 0 && group < static_cast<std::int64_t>(count)) continue;
      refuse(path_, message("a cell names ", what, " ", group, ", there are ", count));
    }
  }

  template <class Nodes>
  void require_points(const Nodes& nodes, const std::string& who) const {
    for (const Index n : nodes) {
      if (n < 0 || n >= std::ssize(e_.points)) refuse(path_, who + " names a missing point");
    }
  }

  void require_finite(const Vec3& p) const {
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) return;
    refuse(path_, "a coordinate is not finite");
  }

  void require_material(const FiniteElements::Elastic& m) const {
    const bool fits = m.modulus > 0 && std::isfinite(m.modulus) && m.poisson > -1 &&
                      m.poisson < 0.5 && m.density >= 0 && std::isfinite(m.density);
    if (fits) return;
    refuse(path_,
           message("material ", in_quotes(m.name), ": expected a modulus above 0 MPa, a Poisson ",
                   "ratio above -1 and below 0.5 and a density of at least 0 g/cm^3, found ",
                   m.modulus, ", ", m.poisson, ", ", m.density));
  }

  void require_set(const FiniteElements::FaceSet& set) const {
    require_points(set.nodes, "set " + in_quotes(set.name));
    for (const auto& [cell, vertex] : set.faces) {
      if (cell >= 0 && cell < std::ssize(e_.cells) && vertex >= 0 && vertex < 4) continue;
      refuse(path_, message("set ", in_quotes(set.name), " names face ", vertex, " of cell ", cell,
                            ", there are 4 faces (from 0) and ", e_.cells.size(), " cells"));
    }
  }

  void require_name(const std::string& name, std::set<std::string>& seen) const {
    if (!is_solver_name(name)) {
      refuse(path_,
             message("expected a name of letters, digits and underscores that begins with a ",
                     "letter and has at most ", kLongestSolverName, " characters, found ",
                     in_quotes(name)));
    }
    if (!seen.insert(lower(name)).second) {
      refuse(path_,
             "expected names of parts, materials and sets that differ, and none ALL, found " +
                 in_quotes(name) + " again");
    }
  }

  void require_names() const {
    std::set<std::string> seen{"all"};
    for (const auto& part : e_.parts) require_name(part.name, seen);
    for (const auto& material : e_.materials) require_name(material.name, seen);
    for (const auto& set : e_.sets) require_name(set.name, seen);
  }

  const std::filesystem::path& path_;
  const FiniteElements& e_;
};

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const Named& item : items) names.push_back(item.name);
  return names;
}

/// Of each set an array "set_NAME": 1 at its nodes, 0 elsewhere.
std::vector<MeshArray> set_arrays(const FiniteElements& elements) {
  std::vector<MeshArray> arrays;
  for (const FiniteElements::FaceSet& set : elements.sets) {
    MeshArray& array = arrays.emplace_back(MeshArray{"set_" + set.name, 1, {}});
    array.values.assign(elements.points.size(), 0);
    for (const Index node : set.nodes) array.values[static_cast<std::size_t>(node)] = 1;
  }
  return arrays;
}

void write_vtu_elements(const OutputPath& path, const FiniteElements& elements,
                        const ElementWriteOptions& options) {
  VtuGrid grid{elements.points, elements.cells, elements.mid_nodes};
  grid.field_data.push_back(vtk_text_bytes("PartNames", names_of(elements.parts)));
  if (!elements.materials.empty()) {
    grid.field_data.push_back(vtk_text_bytes("MaterialNames", names_of(elements.materials)));
  }
  std::vector<MeshArray> arrays = material_arrays(elements);
  arrays.insert(arrays.end(), options.cell_arrays.begin(), options.cell_arrays.end());
  std::vector<MeshArray> point_arrays(options.point_arrays.begin(), options.point_arrays.end());
  for (MeshArray& set : set_arrays(elements)) point_arrays.push_back(std::move(set));
  write_vtu_grid(path, grid, {point_arrays, arrays, options.frame});
}

void write_medit_elements(const OutputPath& path, const FiniteElements& elements,
                          const ElementWriteOptions& options) {
  if (!elements.mid_nodes.empty()) {
    refuse(path,
           "expected linear elements for .mesh, found mid-side nodes; .inp, .feb, .msh and "
           ".vtu hold them");
  }
  std::vector<Index> references = elements.part_of_cell;
  for (Index& part : references) ++part;
  write_medit_mesh(path, {elements.points, elements.cells}, options.frame, references);
}

}  // namespace

std::vector<std::vector<Index>> cells_by_group(const std::vector<Index>& group_of_cell,
                                               std::size_t count) {
  std::vector<std::vector<Index>> cells(count);
  for (std::size_t c = 0; c < group_of_cell.size(); ++c) {
    cells[static_cast<std::size_t>(group_of_cell[c])].push_back(static_cast<Index>(c));
  }
  return cells;
}

std::vector<MeshArray> material_arrays(const FiniteElements& elements) {
  std::vector<MeshArray> arrays;
  const auto add = [&](const char* name, auto value_at) {
    MeshArray& array = arrays.emplace_back(MeshArray{name, 1, {}});
    array.values.reserve(elements.cells.size());
    for (std::size_t c = 0; c < elements.cells.size(); ++c) array.values.push_back(value_at(c));
  };
  add("part", [&](std::size_t c) { return elements.part_of_cell[c] + 1.0; });
  if (elements.materials.empty()) return arrays;
  const auto of = [&](std::size_t c) -> const FiniteElements::Elastic& {
    return elements.materials[static_cast<std::size_t>(elements.material_of_cell[c])];
  };
  add("material", [&](std::size_t c) { return elements.material_of_cell[c] + 1.0; });
  add("modulus", [&](std::size_t c) { return of(c).modulus; });
  add("poisson", [&](std::size_t c) { return of(c).poisson; });
  add("density", [&](std::size_t c) { return of(c).density; });
  return arrays;
}

void write_elements(const OutputPath& path, const FiniteElements& elements,
                    const ElementWriteOptions& options) {
  Checks(path, elements).run();
  const std::string extension = lower_extension(path);
  if (extension == ".inp") return write_abaqus_elements(path, elements, options);
  if (extension == ".feb") return write_febio(path, elements, options);
  if (extension == ".msh") return write_gmsh_elements(path, elements, options);
  if (extension == ".vtu") return write_vtu_elements(path, elements, options);
  if (extension == ".mesh") return write_medit_elements(path, elements, options);
  refuse_extension(path, ".inp .feb .msh .vtu .mesh");
}

}  // namespace mesamis::detail::shape_files
