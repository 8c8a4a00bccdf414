// SPDX-License-Identifier: Apache-2.0
// The VTK side of mesh_files.h; the Medit side is medit_files.cpp.
#include "mesamis/io/mesh_files.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "mesamis/base/error.h"
#include "mesamis/io/atomic_file.h"
#include "mesamis/io/detail/byte_source.h"
#include "mesamis/io/detail/refuse.h"
#include "mesamis/io/detail/vtk_data.h"
#include "mesamis/io/detail/vtk_messages.h"
#include "mesamis/io/detail/vtu_file.h"

namespace mesamis {

using namespace detail;

namespace {

/// Half a turn about z, from LPS to RAS or back: vectors and tensors turn with the points.
void turn(MeshArray& array) {
  const auto step = static_cast<std::size_t>(array.components);
  for (std::size_t i = 0; i + step <= array.values.size(); i += step) {
    if (step == 3) {
      array.values[i] = -array.values[i];
      array.values[i + 1] = -array.values[i + 1];
    } else if (step == 6) {
      array.values[i + 4] = -array.values[i + 4];  // yz
      array.values[i + 5] = -array.values[i + 5];  // xz
    }
  }
}

void turn(std::vector<Vec3>& points) {
  for (Vec3& p : points) p = {-p.x, -p.y, p.z};
}

void add_arrays(vtkFieldData& data, std::span<const MeshArray> source, std::size_t count,
                const char* what, Frame frame) {
  for (MeshArray array : source) {
    if (frame == Frame::kRas) turn(array);
    add_array(data, array, count, what);
  }
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const TetMesh& mesh,
               std::span<const MeshArray> point_arrays, std::span<const MeshArray> cell_arrays,
               Frame frame) {
  const VtkMessages messages;
  const auto grid = vtk_grid(mesh);
  if (frame == Frame::kRas) {
    std::vector<Vec3> turned = mesh.points;
    turn(turned);
    grid->SetPoints(vtk_points(turned));
  }
  add_arrays(*grid->GetPointData(), point_arrays, mesh.points.size(), "point", frame);
  add_arrays(*grid->GetCellData(), cell_arrays, mesh.cells.size(), "cell", frame);
  add_text(*grid->GetFieldData(), kFrameName, frame == Frame::kRas ? kRasName : "LPS");
  add_text(*grid->GetFieldData(), "LengthUnit", "mm");

  AtomicFile file(path);
  const auto writer = vtkSmartPointer<vtkXMLUnstructuredGridWriter>::New();
  writer->SetFileName(file.temporary_path().c_str());
  writer->SetInputData(grid);
  set_form(*writer);
  if (writer->Write() == 0 || writer->GetErrorCode() != 0) {
    refuse(path.string(), "cannot be written: " + messages.first_error());
  }
  file.commit();
}

MeshWithArrays read_vtu(const std::filesystem::path& path) {
  VtuContents contents = parse_vtu(path, read_all(path));
  MeshWithArrays& result = contents.grid;
  if (contents.frame == Frame::kRas) {
    turn(result.mesh.points);
    for (MeshArray& array : result.point_arrays) turn(array);
    for (MeshArray& array : result.cell_arrays) turn(array);
  }
  return std::move(result);
}

}  // namespace mesamis
