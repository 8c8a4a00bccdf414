// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/byte_source.h"
#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/vtk_xml.h"
#include "mesamis/shape_files/vtu_writer.h"

namespace mesamis {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFrameName = "SPACE";  // the field data that state the frame
constexpr int kTetrahedronType = 10;         // VTK's number for this type of cell
constexpr int kQuadraticTetrahedronType = 24;

/// A .vtu as it lies in the file.
struct VtuContents {
  MeshWithArrays grid;
  Frame frame = Frame::kLps;
};

class VtuParser {
 public:
  VtuParser(const fs::path& file, std::string_view bytes, MemoryBudget& budget)
      : file_(file), budget_(budget), xml_(file, bytes, "UnstructuredGrid", budget) {}

  VtuContents parse() {
    const XmlElement* piece = nullptr;
    for (const XmlElement& child : xml_.data_set().children) {
      if (child.name == "FieldData") read_frame(child);
      if (child.name != "Piece") continue;
      if (piece != nullptr) refuse(file_, "expected one piece, found several");
      piece = &child;
    }
    if (piece == nullptr) refuse(file_, "holds no points");
    MeshWithArrays& grid = contents_.grid;
    read_points(*piece);
    read_cells(*piece);
    grid.point_arrays = arrays(piece->child("PointData"), grid.mesh.points.size());
    grid.cell_arrays = arrays(piece->child("CellData"), grid.mesh.cells.size());
    return std::move(contents_);
  }

 private:
  void read_frame(const XmlElement& field_data) {
    for (const XmlElement& array : field_data.children) {
      if (array.attribute("Name") == kFrameName && xml_.text(array) == frame_name(Frame::kRas)) {
        contents_.frame = Frame::kRas;
      }
    }
  }

  std::size_t index_count(const XmlElement& piece, const char* name) const {
    const std::size_t count = count_in(file_, piece, name);
    if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
      refuse(file_, message(name, " is ", count, ", more than 32-bit indices can name"));
    }
    return count;
  }

  /// The values of the array of this name, or of the first array if name is null.
  std::vector<double> values_of(const XmlElement& piece, const char* parent, const char* name,
                                std::size_t count) {
    const XmlElement* element = piece.child(parent);
    if (element != nullptr) {
      for (const XmlElement& array : element->children) {
        if (array.name != "DataArray") continue;
        if (name != nullptr && array.attribute("Name") != name) continue;
        return xml_.values(array, count);
      }
    }
    refuse(file_,
           message("expected an array of ", name == nullptr ? parent : name, ", found none"));
  }

  void read_points(const XmlElement& piece) {
    const std::size_t count = index_count(piece, "NumberOfPoints");
    if (count == 0) refuse(file_, "holds no points");
    std::vector<double> values = values_of(piece, "Points", nullptr, 3 * count);
    std::vector<Vec3>& points = contents_.grid.mesh.points;
    reserve_within(budget_, points, count, "points");
    points.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      points[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    }
    free_within(budget_, values);
  }

  [[noreturn]] void refuse_cell(std::size_t cell, const std::string& what) const {
    refuse(file_, message("cell ", cell, " ", what));
  }

  /// The numbers of points of the cells: 4, or 10 with mid-side nodes.
  std::vector<std::uint8_t> read_sizes(const XmlElement& piece, std::size_t count) {
    std::vector<double> types = values_of(piece, "Cells", "types", count);
    std::vector<std::uint8_t> sizes;
    reserve_within(budget_, sizes, count, "types of cells");
    for (std::size_t c = 0; c < count; ++c) {
      const bool quadratic = types[c] == kQuadraticTetrahedronType;
      if (!quadratic && types[c] != kTetrahedronType) {
        refuse_cell(c, message("is of VTK type ", types[c], ", expected tetrahedra (type ",
                               kTetrahedronType, ", or ", kQuadraticTetrahedronType,
                               " with mid-side nodes)"));
      }
      contents_.grid.quadratic = contents_.grid.quadratic || quadratic;
      sizes.push_back(quadratic ? 10 : 4);
    }
    free_within(budget_, types);
    return sizes;
  }

  void read_cells(const XmlElement& piece) {
    const std::size_t count = index_count(piece, "NumberOfCells");
    if (count == 0) return;
    std::vector<std::uint8_t> sizes = read_sizes(piece, count);
    std::vector<double> offsets = values_of(piece, "Cells", "offsets", count);
    std::size_t end = 0;
    for (std::size_t c = 0; c < count; ++c) {
      end += sizes[c];
      if (offsets[c] != static_cast<double>(end)) {
        refuse_cell(c, message("has not ", sizes[c] == 4 ? "four" : "ten", " points"));
      }
    }
    free_within(budget_, offsets);
    std::vector<double> nodes = values_of(piece, "Cells", "connectivity", end);
    TetMesh& mesh = contents_.grid.mesh;
    reserve_within(budget_, mesh.cells, count, "cells");
    mesh.cells.resize(count);
    std::size_t first = 0;
    for (std::size_t c = 0; c < count; first += sizes[c], ++c) {
      for (std::size_t i = 0; i < sizes[c]; ++i) {
        const Index node = point_of(nodes[first + i], c);
        if (i < 4) mesh.cells[c][i] = node;
      }
    }
    free_within(budget_, nodes);
    free_within(budget_, sizes);
  }

  Index point_of(double node, std::size_t cell) const {
    const auto points = static_cast<double>(contents_.grid.mesh.points.size());
    if (!(node >= 0 && node < points)) refuse_cell(cell, "names a missing point");
    return static_cast<Index>(node);
  }

  std::vector<MeshArray> arrays(const XmlElement* data, std::size_t count) {
    std::vector<MeshArray> result;
    if (data == nullptr) return result;
    for (const XmlElement& element : data->children) {
      if (element.name != "DataArray") continue;  // text
      MeshArray array;
      array.name = element.attribute("Name");
      const std::size_t components = components_in(file_, element);
      array.values = xml_.values(element, count * components);
      array.components = static_cast<int>(components);
      append_within(budget_, result, std::move(array), "arrays");
    }
    return result;
  }

  const fs::path& file_;
  MemoryBudget& budget_;
  VtkXml xml_;
  VtuContents contents_;
};

/// Whether half a turn about z, from LPS to RAS or back, negates this component of an array:
/// vectors and tensors (xx yy zz xy yz xz) turn with the points.
bool is_negated(int components, std::size_t component) {
  return (components == 3 && component < 2) || (components == 6 && component >= 4);
}

double turned_value(const MeshArray& array, std::size_t i) {
  const std::size_t component = i % static_cast<std::size_t>(array.components);
  return is_negated(array.components, component) ? -array.values[i] : array.values[i];
}

void turn(MeshArray& array) {
  for (std::size_t i = 0; i < array.values.size(); ++i) array.values[i] = turned_value(array, i);
}

void turn(std::vector<Vec3>& points) {
  for (Vec3& p : points) p = in_frame(p, Frame::kRas);
}

void require_size(const MeshArray& array, std::size_t count, const char* kind) {
  const std::string what = message("mesh: ", kind, " array '", array.name, "' has ");
  if (array.components < 1 || array.components > kMostComponents) {
    throw InputError(
        message(what, array.components, " components, expected 1 to ", kMostComponents));
  }
  if (array.values.size() != count * static_cast<std::size_t>(array.components)) {
    throw InputError(message(what, array.values.size(), " values, expected ", count, " times ",
                             array.components));
  }
}

VtkArrayGroup group_of(const char* element, std::span<const MeshArray> arrays, std::size_t count,
                       const char* kind, Frame frame) {
  VtkArrayGroup group{element, {}};
  for (const MeshArray& array : arrays) {
    require_size(array, count, kind);
    group.arrays.push_back(vtk_array<double>(
        array.name, array.components, array.values.size(), [&array, frame](std::size_t i) {
          return frame == Frame::kRas ? turned_value(array, i) : array.values[i];
        }));
  }
  return group;
}

VtkArrayGroup group_of_points(std::span<const Vec3> points, Frame frame) {
  return {"Points", {vtk_array<double>("Points", 3, 3 * points.size(), [=](std::size_t i) {
            return in_frame(points[i / 3], frame)[static_cast<int>(i % 3)];
          })}};
}

VtkArrayGroup group_of_cells(const VtuGrid& grid) {
  const std::size_t nodes = grid.mid_nodes.empty() ? 4 : 10, cells = grid.cells.size();
  if (cells > std::numeric_limits<std::int32_t>::max() / nodes) {
    throw InputError(message("mesh: ", cells, " cells are too many for a VTK file"));
  }
  auto node = [&grid, nodes](std::size_t i) {
    const std::size_t cell = i / nodes, place = i % nodes;
    return place < 4 ? grid.cells[cell][place] : grid.mid_nodes[cell][place - 4];
  };
  const int type = nodes == 4 ? kTetrahedronType : kQuadraticTetrahedronType;
  return {"Cells",
          {vtk_array<std::int32_t>("connectivity", 1, nodes * cells, node),
           vtk_array<std::int32_t>("offsets", 1, cells,
                                   [nodes](std::size_t c) { return nodes * (c + 1); }),
           vtk_array<std::uint8_t>("types", 1, cells, [type](std::size_t) { return type; })}};
}

}  // namespace

void detail::shape_files::write_vtu_grid(const OutputPath& path, const VtuGrid& grid,
                                         const VtuOptions& options) {
  const Frame frame = options.frame;
  const std::size_t points = grid.points.size(), cells = grid.cells.size();
  VtkFile file{
      "UnstructuredGrid",
      {vtk_text_bytes(kFrameName, {frame_name(frame)}), vtk_text_bytes("LengthUnit", {"mm"})},
      {{"NumberOfPoints", points}, {"NumberOfCells", cells}},
      {group_of("PointData", options.point_arrays, points, "point", frame),
       group_of("CellData", options.cell_arrays, cells, "cell", frame),
       group_of_points(grid.points, frame), group_of_cells(grid)}};
  file.field_data.insert(file.field_data.end(), grid.field_data.begin(), grid.field_data.end());
  write_vtk_xml(path, file);
}

void write_vtu(const OutputPath& path, const TetMesh& mesh, const VtuOptions& options) {
  write_vtu_grid(path, {mesh.points, mesh.cells}, options);
}

MeshWithArrays read_vtu(const std::filesystem::path& path, const ReadLimits& limits) {
  MemoryBudget budget(path, limits);
  const std::string bytes = read_all(path, budget);
  VtuContents contents = VtuParser(path, bytes, budget).parse();
  MeshWithArrays& result = contents.grid;
  if (contents.frame == Frame::kRas) {
    turn(result.mesh.points);
    for (MeshArray& array : result.point_arrays) turn(array);
    for (MeshArray& array : result.cell_arrays) turn(array);
  }
  return std::move(result);
}

}  // namespace mesamis
