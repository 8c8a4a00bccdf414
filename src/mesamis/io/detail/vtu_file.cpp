// SPDX-License-Identifier: Apache-2.0
// Reading a .vtu; mesh_files.cpp writes it.
#include "mesamis/io/detail/vtu_file.h"

#include <limits>
#include <utility>

#include "mesamis/io/detail/refuse.h"
#include "mesamis/io/detail/vtk_xml.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

constexpr int kTetrahedron = 10;  // VTK's number for this type of cell

class VtuParser {
 public:
  VtuParser(const fs::path& file, std::string_view bytes)
      : file_(file), xml_(file, bytes, "UnstructuredGrid") {}

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
      if (array.attribute("Name") == kFrameName && xml_.text(array) == kRasName) {
        contents_.frame = Frame::kRas;
      }
    }
  }

  std::size_t index_count(const XmlElement& piece, const char* name) const {
    const std::size_t count = count_in(file_, piece, name);
    if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
      refuse(file_, say(name, " is ", count, ", more than 32-bit indices can name"));
    }
    return count;
  }

  /// The values of the array of this name, or of the first array if name is null.
  std::vector<double> values_of(const XmlElement& piece, const char* parent, const char* name,
                                std::size_t count) const {
    const XmlElement* element = piece.child(parent);
    if (element != nullptr) {
      for (const XmlElement& array : element->children) {
        if (array.name != "DataArray") continue;
        if (name != nullptr && array.attribute("Name") != name) continue;
        std::vector<double> values = xml_.values(array);
        if (values.size() != count) {
          refuse(file_, say("expected ", count, " values in ", name == nullptr ? parent : name,
                            ", found ", values.size()));
        }
        return values;
      }
    }
    refuse(file_, say("expected an array of ", name == nullptr ? parent : name, ", found none"));
  }

  void read_points(const XmlElement& piece) {
    const std::size_t count = index_count(piece, "NumberOfPoints");
    if (count == 0) refuse(file_, "holds no points");
    const std::vector<double> values = values_of(piece, "Points", nullptr, 3 * count);
    std::vector<Vec3>& points = contents_.grid.mesh.points;
    points.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      points[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    }
  }

  [[noreturn]] void refuse_cell(std::size_t cell, const std::string& what) const {
    refuse(file_, say("cell ", cell, " ", what));
  }

  void read_cells(const XmlElement& piece) {
    const std::size_t count = index_count(piece, "NumberOfCells");
    if (count == 0) return;
    const std::vector<double> types = values_of(piece, "Cells", "types", count);
    for (std::size_t c = 0; c < count; ++c) {
      if (types[c] != kTetrahedron) {
        refuse_cell(
            c, say("is of VTK type ", types[c], ", expected tetrahedra (type ", kTetrahedron, ")"));
      }
    }
    const std::vector<double> offsets = values_of(piece, "Cells", "offsets", count);
    for (std::size_t c = 0; c < count; ++c) {
      if (offsets[c] != 4.0 * static_cast<double>(c + 1)) refuse_cell(c, "has not four points");
    }
    const std::vector<double> corners = values_of(piece, "Cells", "connectivity", 4 * count);
    TetMesh& mesh = contents_.grid.mesh;
    const auto points = static_cast<double>(mesh.points.size());
    mesh.cells.resize(count);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!(corners[i] >= 0 && corners[i] < points)) refuse_cell(i / 4, "names a missing point");
      mesh.cells[i / 4][i % 4] = static_cast<Index>(corners[i]);
    }
  }

  std::vector<MeshArray> arrays(const XmlElement* data, std::size_t count) const {
    std::vector<MeshArray> result;
    if (data == nullptr) return result;
    for (const XmlElement& element : data->children) {
      if (element.name != "DataArray") continue;  // text
      MeshArray array;
      array.name = element.attribute("Name");
      const bool scalar = element.attribute("NumberOfComponents").empty();
      const std::size_t components = scalar ? 1 : count_in(file_, element, "NumberOfComponents");
      array.values = xml_.values(element);
      if (components == 0 || array.values.size() / components != count ||
          array.values.size() % components != 0) {
        refuse(file_, say("the array ", in_quotes(array.name), " has ", array.values.size(),
                          " values, expected ", count, " times ", components));
      }
      array.components = static_cast<int>(components);
      result.push_back(std::move(array));
    }
    return result;
  }

  const fs::path& file_;
  VtkXml xml_;
  VtuContents contents_;
};

}  // namespace

VtuContents parse_vtu(const fs::path& file, std::string_view bytes) {
  return VtuParser(file, bytes).parse();
}

}  // namespace mesamis::detail
