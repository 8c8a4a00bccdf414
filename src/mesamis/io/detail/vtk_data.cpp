// SPDX-License-Identifier: Apache-2.0
#include "mesamis/io/detail/vtk_data.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/io/detail/refuse.h"

namespace mesamis::detail {
namespace {

/// Cells of `corners` points each, with 32-bit indices as ours.
template <class Cells>
vtkSmartPointer<vtkCellArray> vtk_cells(const Cells& cells, int corners) {
  const auto count = static_cast<vtkIdType>(cells.size());
  auto offsets = vtkSmartPointer<vtkTypeInt32Array>::New();
  auto connectivity = vtkSmartPointer<vtkTypeInt32Array>::New();
  if (count * corners > std::numeric_limits<std::int32_t>::max()) {
    throw InputError("mesh: " + std::to_string(count) + " cells are too many for a VTK file");
  }
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(count * corners);
  offsets->SetValue(0, 0);
  for (vtkIdType c = 0; c < count; ++c) {
    const auto& cell = cells[static_cast<std::size_t>(c)];
    std::copy(cell.begin(), cell.end(), connectivity->GetPointer(c * corners));
    offsets->SetValue(c + 1, static_cast<std::int32_t>((c + 1) * corners));
  }
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(offsets, connectivity);
  return result;
}

[[noreturn]] void refuse_cell(const std::string& name, vtkIdType cell, const std::string& what) {
  refuse(name, "cell " + std::to_string(cell) + " " + what);
}

void require_tetrahedra(vtkUnstructuredGrid& grid, const std::string& name) {
  vtkUnsignedCharArray* types = grid.GetCellTypesArray();
  vtkDataArray* offsets = grid.GetCells()->GetOffsetsArray();
  const vtkIdType cells = grid.GetCells()->GetNumberOfCells();
  if (types == nullptr || types->GetNumberOfTuples() != cells) {
    refuse(name, "expected one type per cell");
  }
  for (vtkIdType c = 0; c < cells; ++c) {
    if (types->GetValue(c) != VTK_TETRA) {
      refuse_cell(name, c,
                  "is of VTK type " + std::to_string(types->GetValue(c)) +
                      ", expected tetrahedra (type " + std::to_string(VTK_TETRA) + ")");
    }
    if (offsets->GetComponent(c + 1, 0) != 4.0 * static_cast<double>(c + 1)) {
      refuse_cell(name, c, "has not four points");
    }
  }
  if (grid.GetCells()->GetConnectivityArray()->GetNumberOfValues() < 4 * cells) {
    refuse(name, "the list of the cells' points is too short");
  }
}

}  // namespace

vtkSmartPointer<vtkPoints> vtk_points(std::span<const Vec3> points) {
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    result->SetPoint(static_cast<vtkIdType>(i), points[i].x, points[i].y, points[i].z);
  }
  return result;
}

vtkSmartPointer<vtkPolyData> vtk_surface(const TriMesh& surface) {
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(vtk_points(surface.points));
  result->SetPolys(vtk_cells(surface.triangles, 3));
  return result;
}

vtkSmartPointer<vtkUnstructuredGrid> vtk_grid(const TetMesh& mesh) {
  auto result = vtkSmartPointer<vtkUnstructuredGrid>::New();
  result->SetPoints(vtk_points(mesh.points));
  result->SetCells(VTK_TETRA, vtk_cells(mesh.cells, 4));
  return result;
}

void add_array(vtkFieldData& data, const MeshArray& array, std::size_t count, const char* what) {
  if (array.components < 1 ||
      array.values.size() != count * static_cast<std::size_t>(array.components)) {
    throw InputError("mesh: " + std::string(what) + " array '" + array.name + "' has " +
                     std::to_string(array.values.size()) + " values, expected " +
                     std::to_string(count) + " times " + std::to_string(array.components));
  }
  auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName(array.name.c_str());
  values->SetNumberOfComponents(array.components);
  values->SetNumberOfTuples(static_cast<vtkIdType>(count));
  std::copy(array.values.begin(), array.values.end(), values->GetPointer(0));
  data.AddArray(values);
}

TetMesh tet_mesh(vtkUnstructuredGrid& grid, const std::string& name) {
  TetMesh mesh;
  if (grid.GetPoints() == nullptr || grid.GetNumberOfPoints() == 0) {
    refuse(name, "holds no points");
  }
  if (grid.GetNumberOfPoints() > std::numeric_limits<Index>::max() ||
      grid.GetCells()->GetNumberOfCells() > std::numeric_limits<Index>::max()) {
    refuse(name, "the mesh exceeds 32-bit indices");
  }
  require_tetrahedra(grid, name);
  mesh.points.resize(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    double p[3];
    grid.GetPoint(static_cast<vtkIdType>(i), p);
    mesh.points[i] = {p[0], p[1], p[2]};
  }
  vtkDataArray& corners = *grid.GetCells()->GetConnectivityArray();
  const auto points = static_cast<double>(mesh.points.size());
  mesh.cells.resize(static_cast<std::size_t>(grid.GetCells()->GetNumberOfCells()));
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double point = corners.GetComponent(static_cast<vtkIdType>(4 * c + i), 0);
      if (!(point >= 0 && point < points)) {
        refuse_cell(name, static_cast<vtkIdType>(c), "names a missing point");
      }
      mesh.cells[c][i] = static_cast<Index>(point);
    }
  }
  return mesh;
}

std::vector<MeshArray> arrays(vtkFieldData& data, std::size_t count, const std::string& name) {
  std::vector<MeshArray> result;
  for (int a = 0; a < data.GetNumberOfArrays(); ++a) {
    vtkDataArray* values = data.GetArray(a);
    if (values == nullptr) continue;  // text
    MeshArray array;
    array.name = values->GetName() == nullptr ? "" : values->GetName();
    array.components = values->GetNumberOfComponents();
    if (values->GetNumberOfTuples() != static_cast<vtkIdType>(count)) {
      refuse(name, "array '" + array.name + "' has " + std::to_string(values->GetNumberOfTuples()) +
                       " tuples, expected " + std::to_string(count));
    }
    array.values.resize(count * static_cast<std::size_t>(array.components));
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i) {
      values->GetTuple(i, array.values.data() + i * array.components);
    }
    result.push_back(std::move(array));
  }
  return result;
}

}  // namespace mesamis::detail
