// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <span>
#include <string>

#include "mesamis/io/mesh_files.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/tri_mesh.h"

class vtkXMLWriter;

/// Our values as VTK's data sets, and how these are written.
namespace mesamis::detail {

vtkSmartPointer<vtkPoints> vtk_points(std::span<const Vec3> points);

vtkSmartPointer<vtkPolyData> vtk_surface(const TriMesh& surface);

/// Tetrahedra without arrays.
vtkSmartPointer<vtkUnstructuredGrid> vtk_grid(const TetMesh& mesh);

/// Adds an array to the point or cell data of a data set.
/// @param what   for messages, e.g. "point"
/// @throws InputError  if the array has not `count` tuples.
void add_array(vtkFieldData& data, const MeshArray& array, std::size_t count, const char* what);

/// Adds a line of text to the field data.
void add_text(vtkFieldData& data, const char* name, const std::string& value);

/// Appended raw binary, 64-bit headers, lightly packed by zlib.
void set_form(vtkXMLWriter& writer);

}  // namespace mesamis::detail
