// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/vtk_data.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>
#include <limits>

#include "mesamis/base/error.h"

namespace mesamis::detail {
namespace {

/// Cells of `corners` points each, with 32-bit indices as ours.
template <class Cells>
vtkSmartPointer<vtkCellArray> vtk_cells(const Cells& cells, int corners) {
  const auto count = static_cast<vtkIdType>(cells.size());
  auto offsets = vtkSmartPointer<vtkTypeInt32Array>::New();
  auto connectivity = vtkSmartPointer<vtkTypeInt32Array>::New();
  if (count * corners > std::numeric_limits<std::int32_t>::max()) {
    throw InputError("mesh: " + std::to_string(count) + " cells are too many for VTK");
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

}  // namespace mesamis::detail
