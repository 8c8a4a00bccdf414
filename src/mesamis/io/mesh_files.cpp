// SPDX-License-Identifier: Apache-2.0
// The VTK side of mesh_files.h; the Medit side is medit_files.cpp.
#include "mesamis/io/mesh_files.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <fstream>
#include <new>

#include "mesamis/base/error.h"
#include "mesamis/io/atomic_file.h"
#include "mesamis/io/detail/refuse.h"
#include "mesamis/io/detail/vtk_data.h"
#include "mesamis/io/detail/vtk_messages.h"

namespace mesamis {

using namespace detail;

namespace {

constexpr const char* kFrameName = "SPACE";
constexpr const char* kRasName = "RAS";

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

void add_text(vtkFieldData& data, const char* name, const char* value) {
  auto text = vtkSmartPointer<vtkStringArray>::New();
  text->SetName(name);
  text->InsertNextValue(value);
  data.AddArray(text);
}

bool is_ras(vtkFieldData& data) {
  auto* frame = vtkStringArray::SafeDownCast(data.GetAbstractArray(kFrameName));
  return frame != nullptr && frame->GetNumberOfValues() == 1 && frame->GetValue(0) == kRasName;
}

void add_arrays(vtkFieldData& data, std::span<const MeshArray> source, std::size_t count,
                const char* what, Frame frame) {
  for (MeshArray array : source) {
    if (frame == Frame::kRas) turn(array);
    add_array(data, array, count, what);
  }
}

/// The value of the first `name="..."` in the text, or 0.
double attribute(const std::string& text, const std::string& name) {
  const auto at = text.find(" " + name + "=\"");
  return at == std::string::npos ? 0 : std::strtod(text.c_str() + at + name.size() + 3, nullptr);
}

/// VTK allocates what a header says before it reads; so the header is checked against the most
/// that the file can hold: deflate packs at most 1032 bytes into one.
void require_plausible(const std::filesystem::path& path, const std::string& name) {
  std::ifstream in(path, std::ios::binary);
  if (!in) refuse(name, "cannot be opened");
  std::string head(1 << 16, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.find("<VTKFile") == std::string::npos ||
      head.find("UnstructuredGrid") == std::string::npos) {
    refuse(name, "is not a VTK unstructured grid in XML (.vtu)");
  }
  const double most = 1032.0 * static_cast<double>(std::filesystem::file_size(path));
  const double points = attribute(head, "NumberOfPoints");
  const double cells = attribute(head, "NumberOfCells");
  if (!(points >= 0 && cells >= 0 && 12 * points + 16 * cells <= most)) {
    refuse(name, "the header promises more points or cells than the file can hold");
  }
}

MeshWithArrays convert(vtkUnstructuredGrid& grid, const std::string& name) {
  MeshWithArrays result;
  result.mesh = tet_mesh(grid, name);
  result.point_arrays = arrays(*grid.GetPointData(), result.mesh.points.size(), name);
  result.cell_arrays = arrays(*grid.GetCellData(), result.mesh.cells.size(), name);
  if (is_ras(*grid.GetFieldData())) {
    turn(result.mesh.points);
    for (MeshArray& array : result.point_arrays) turn(array);
    for (MeshArray& array : result.cell_arrays) turn(array);
  }
  return result;
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
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // doubles pack badly; more effort gains little
  if (writer->Write() == 0 || writer->GetErrorCode() != 0) {
    refuse(path.string(), "cannot be written: " + messages.first_error());
  }
  file.commit();
}

MeshWithArrays read_vtu(const std::filesystem::path& path) {
  const std::string name = path.string();
  require_plausible(path, name);
  const VtkMessages messages;
  const auto reader = vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  try {
    reader->SetFileName(path.c_str());
    reader->Update();
    if (reader->GetErrorCode() != 0 || !messages.first_error().empty()) {
      refuse(name, "cannot be read: " + messages.first_error());
    }
    return convert(*reader->GetOutput(), name);
  } catch (const std::bad_alloc&) {
    refuse(name, "needs more memory than there is");
  }
}

}  // namespace mesamis
