// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <span>
#include <string>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/surface/tri_mesh.h"

/// Values of this project as VTK's data sets.
namespace mesamis::detail {

/// Points in double precision.
vtkSmartPointer<vtkPoints> vtk_points(std::span<const Vec3> points);

/// Triangles with 32-bit indices.
/// @throws InputError  if there are more corners than 32-bit indices can number.
vtkSmartPointer<vtkPolyData> vtk_surface(const TriMesh& surface);

/// Tetrahedra without arrays.
/// @throws InputError  as vtk_surface().
vtkSmartPointer<vtkUnstructuredGrid> vtk_grid(const TetMesh& mesh);

/// Adds an array to the point or cell data of a data set.
/// @param what   for messages, e.g. "point"
/// @throws InputError  if the array has not `count` tuples.
void add_array(vtkFieldData& data, const MeshArray& array, std::size_t count, const char* what);

}  // namespace mesamis::detail
