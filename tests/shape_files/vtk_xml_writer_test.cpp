// SPDX-License-Identifier: Apache-2.0
// The bytes of our VTK files are those of VTK's own writers.
#include "mesamis/shape_files/vtk_xml_writer.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <random>

#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/shape_files/vtk_xml.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

vtkSmartPointer<vtkPoints> vtk_points(const std::vector<Vec3>& points, Frame frame) {
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  const double sign = frame == Frame::kRas ? -1 : 1;
  for (const Vec3& p : points) result->InsertNextPoint(sign * p.x, sign * p.y, p.z);
  return result;
}

template <class Cells>
vtkSmartPointer<vtkCellArray> vtk_cells(const Cells& cells, std::int32_t corners) {
  auto offsets = vtkSmartPointer<vtkTypeInt32Array>::New();
  auto connectivity = vtkSmartPointer<vtkTypeInt32Array>::New();
  offsets->InsertNextValue(0);
  for (const auto& cell : cells) {
    for (const Index n : cell) connectivity->InsertNextValue(n);
    offsets->InsertNextValue(offsets->GetValue(offsets->GetNumberOfValues() - 1) + corners);
  }
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(offsets, connectivity);
  return result;
}

void add_array(vtkFieldData& data, const MeshArray& array) {
  auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName(array.name.c_str());
  values->SetNumberOfComponents(array.components);
  values->SetNumberOfValues(static_cast<vtkIdType>(array.values.size()));
  std::copy(array.values.begin(), array.values.end(), values->GetPointer(0));
  data.AddArray(values);
}

void add_text(vtkFieldData& data, const char* name, const std::string& value) {
  auto text = vtkSmartPointer<vtkStringArray>::New();
  text->SetName(name);
  text->InsertNextValue(value);
  data.AddArray(text);
}

void add_text_bytes(vtkFieldData& data, const char* name, const std::string& value) {
  auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  bytes->SetName(name);
  for (const char c : value) bytes->InsertNextValue(static_cast<unsigned char>(c));
  data.AddArray(bytes);
}

template <class Writer, class Data>
std::string bytes_by_vtk(Data* data) {
  const auto writer = vtkSmartPointer<Writer>::New();
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);
  EXPECT_EQ(writer->Write(), 1);
  return writer->GetOutputString();
}

/// Equal, without printing megabytes of binary where they are not.
void expect_same_bytes(const std::string& ours, const std::string& by_vtk) {
  const auto [a, b] = std::mismatch(ours.begin(), ours.end(), by_vtk.begin(), by_vtk.end());
  if (a == ours.end() && b == by_vtk.end()) return;
  const auto at = static_cast<std::size_t>(a - ours.begin());
  const std::size_t from = at < 100 ? 0 : at - 100;
  ADD_FAILURE() << ours.size() << " bytes, expected " << by_vtk.size() << ", first difference at "
                << at << ":\n"
                << testing::PrintToString(ours.substr(from, 200)) << "\nexpected\n"
                << testing::PrintToString(by_vtk.substr(from, 200));
}

MeshArray random_array(const std::string& name, int components, std::size_t count) {
  static std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  MeshArray array{name, components, {}};
  array.values.resize(count * static_cast<std::size_t>(components));
  for (double& value : array.values) value = normal(random);
  return array;
}

struct Grid {
  TetMesh mesh;
  std::vector<MeshArray> point_arrays, cell_arrays;
};

Grid with_arrays(TetMesh mesh) {
  Grid grid{std::move(mesh), {}, {}};
  const std::size_t points = grid.mesh.points.size(), cells = grid.mesh.cells.size();
  for (const int components : {1, 2, 3, 6, 9}) {
    const std::string name = "array of " + std::to_string(components);
    grid.point_arrays.push_back(random_array(name, components, points));
    grid.cell_arrays.push_back(random_array(name, components, cells));
  }
  return grid;
}

/// The plain rule of the frame, written out: what is negated in a RAS file.
MeshArray in_ras(MeshArray array) {
  const auto step = static_cast<std::size_t>(array.components);
  for (std::size_t i = 0; i < array.values.size(); i += step) {
    if (step == 3) array.values[i] *= -1, array.values[i + 1] *= -1;
    if (step == 6) array.values[i + 4] *= -1, array.values[i + 5] *= -1;
  }
  return array;
}

std::string grid_by_vtk(const Grid& grid, Frame frame) {
  auto data = vtkSmartPointer<vtkUnstructuredGrid>::New();
  data->SetPoints(vtk_points(grid.mesh.points, frame));
  data->SetCells(VTK_TETRA, vtk_cells(grid.mesh.cells, 4));
  const bool turns = frame == Frame::kRas;
  for (const MeshArray& a : grid.point_arrays) {
    add_array(*data->GetPointData(), turns ? in_ras(a) : a);
  }
  for (const MeshArray& a : grid.cell_arrays) {
    add_array(*data->GetCellData(), turns ? in_ras(a) : a);
  }
  add_text_bytes(*data->GetFieldData(), "SPACE", turns ? "RAS" : "LPS");
  add_text_bytes(*data->GetFieldData(), "LengthUnit", "mm");
  return bytes_by_vtk<vtkXMLUnstructuredGridWriter>(data.Get());
}

void expect_grid_as_by_vtk(const Grid& grid, Frame frame = Frame::kLps) {
  const TempFolder folder;
  write_vtu(folder / "m.vtu", grid.mesh, {grid.point_arrays, grid.cell_arrays, frame});
  expect_same_bytes(read_bytes(folder / "m.vtu"), grid_by_vtk(grid, frame));
  EXPECT_EQ(folder.file_count(), 1);
}

const TetMesh kOneCell{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};

TEST(VtkXmlWriter, GridsOfAllSizesAreAsByVtk) {
  expect_grid_as_by_vtk({});
  expect_grid_as_by_vtk(with_arrays({}));
  expect_grid_as_by_vtk(with_arrays({{{1, 2, 3}}, {}}));
  expect_grid_as_by_vtk({kOneCell, {}, {}});
  for (const Frame frame : {Frame::kLps, Frame::kRas}) {
    expect_grid_as_by_vtk(with_arrays(kOneCell), frame);
    expect_grid_as_by_vtk(with_arrays(box_mesh({{-1, -2, -3}, {4, 5, 6}}, {9, 11, 12})), frame);
  }
}

/// 4096 doubles fill a block: one value fewer, as many, one more.
TEST(VtkXmlWriter, BlocksEndWhereVtksEnd) {
  for (const std::size_t count : {4095u, 4096u, 4097u, 8192u, 8193u}) {
    Grid grid{kOneCell, {}, {}};
    grid.mesh.points.resize(count, {1, 1, 1});
    grid.point_arrays.push_back(random_array("u", 1, count));
    expect_grid_as_by_vtk(grid);
  }
}

TEST(VtkXmlWriter, RangesOfOddValuesAreAsByVtk) {
  // No mixture of 0 and -0: there VTK's answer depends on the order of its threads.
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<double>> cases{{nan, nan, nan, nan},
                                               {nan, 1, 2, nan},
                                               {-inf, 0, inf, 1},
                                               {-0.0, -0.0, -0.0, -0.0},
                                               {0.1, 1.0 / 3, 7, 8},
                                               {1e-310, 5e-324, 1e-300, 1e-320},
                                               {1e9, 123456789.125, 1e20, 1e21}};
  for (const auto& values : cases) {
    expect_grid_as_by_vtk({kOneCell, {{"odd", 1, values}}, {{"odd", 4, values}}});
  }
}

struct Surface {
  TriMesh mesh;
  SurfaceWriteOptions options;
};

std::string surface_by_vtk(const Surface& surface) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  const SurfaceWriteOptions& options = surface.options;
  data->SetPoints(vtk_points(surface.mesh.points, options.frame.value_or(Frame::kLps)));
  data->SetPolys(vtk_cells(surface.mesh.triangles, 3));
  vtkFieldData& fields = *data->GetFieldData();
  if (options.frame) add_text(fields, "SPACE", options.frame == Frame::kRas ? "RAS" : "LPS");
  add_text(fields, "LengthUnit", "mm");
  if (!options.name.empty()) add_text(fields, "Name", options.name);
  if (!options.grey.empty()) add_array(*data->GetPointData(), {"grey", 1, options.grey});
  for (const auto& [name, values] : options.point_arrays) {
    add_array(*data->GetPointData(), {name, 1, values});
  }
  return bytes_by_vtk<vtkXMLPolyDataWriter>(data.Get());
}

void expect_surface_as_by_vtk(const Surface& surface) {
  const TempFolder folder;
  write_surface(folder / "s.vtp", surface.mesh, surface.options);
  expect_same_bytes(read_bytes(folder / "s.vtp"), surface_by_vtk(surface));
}

TriMesh many_triangles() {
  TriMesh surface;
  for (int n = 0; n < 3000; ++n) {
    const auto first = static_cast<Index>(surface.points.size());
    surface.points.insert(surface.points.end(), {{0.1 * n, 0, 1}, {0.1 * n, 1, 0}, {0, 0, 0.3}});
    surface.triangles.push_back({first, first + 1, first + 2});
  }
  return surface;
}

TEST(VtkXmlWriter, SurfacesAreAsByVtk) {
  expect_surface_as_by_vtk({cube(), {}});
  expect_surface_as_by_vtk({cube(), {.frame = std::nullopt}});
  expect_surface_as_by_vtk({cube(), {.frame = Frame::kRas, .name = "left femur"}});
  expect_surface_as_by_vtk({cube(), {.name = std::string(70'000, 'n')}});  // several blocks
  const TriMesh surface = many_triangles();
  const std::vector<double> grey = random_array("", 1, surface.points.size()).values;
  expect_surface_as_by_vtk({surface, {.name = "M\xc3\xbcller", .grey = grey}});
  expect_surface_as_by_vtk(
      {surface, {.grey = grey, .point_arrays = {{"distance", grey}, {"b", grey}}}});
}

TEST(VtkXmlWriter, TextsAsNumbersAreReadBackAsTexts) {
  const std::vector<std::string> texts{"femur", "os coxae", "M\xc3\xbcller"};
  const std::string file = vtk_xml_bytes(
      {"UnstructuredGrid",
       {vtk_text_bytes("Names", texts), vtk_text_bytes("One", {"LPS"}), vtk_text("Text", "RAS")},
       {{"NumberOfPoints", 0}, {"NumberOfCells", 0}},
       {}});
  MemoryBudget budget("f.vtu", {});
  VtkXml xml("f.vtu", file, "UnstructuredGrid", budget);
  const auto& fields = xml.data_set().child("FieldData")->children;
  ASSERT_EQ(fields.size(), 3u);
  EXPECT_EQ(fields[0].name, "DataArray");
  EXPECT_EQ(xml.texts(fields[0]), texts);
  EXPECT_EQ(xml.text(fields[1]), "LPS");
  EXPECT_EQ(xml.text(fields[2]), "RAS");  // as older files have it
}

TEST(VtkXmlWriter, NamesWithMarkupAreEscapedAndReadBack) {
  const TempFolder folder;
  const std::string name = "a<b> & \"c\"";
  const std::vector<MeshArray> arrays{{name, 1, {1, 2, 3, 4}}};
  write_vtu(folder / "m.vtu", kOneCell, {.point_arrays = arrays});
  const MeshWithArrays back = read_vtu(folder / "m.vtu");
  ASSERT_EQ(back.point_arrays.size(), 1u);
  EXPECT_EQ(back.point_arrays[0].name, name);
}

TEST(VtkXmlWriter, TwoArraysOfOneNameAreRefused) {
  const TempFolder folder;
  const std::vector<MeshArray> arrays{{"u", 1, {1, 2, 3, 4}}, {"u", 1, {5, 6, 7, 8}}};
  const VtuOptions options{.point_arrays = arrays};
  EXPECT_REFUSED(write_vtu(folder / "m.vtu", kOneCell, options), HasSubstr("two named \"u\""));
  EXPECT_EQ(folder.file_count(), 0);
}

/// The exit code of a process whose files may have no more than 4 KiB: it writes nothing else when
/// it ends.
[[noreturn]] void write_with_a_full_disk(const std::filesystem::path& path) {
  const rlimit limit{4096, 4096};
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limit);
  const Grid grid = with_arrays(box_mesh({{0, 0, 0}, {1, 1, 1}}, {8, 8, 8}));
  try {
    write_vtu(path, grid.mesh, {grid.point_arrays, grid.cell_arrays});
  } catch (const InputError& error) {
    std::_Exit(std::string(error.what()).find("m.vtu: cannot be written") == std::string::npos);
  }
  std::_Exit(2);
}

TEST(VtkXmlWriter, AFullDiskIsAnErrorAndLeavesNothing) {
  const TempFolder folder;
  EXPECT_EXIT(write_with_a_full_disk(folder / "m.vtu"), testing::ExitedWithCode(0), "");
  EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace
}  // namespace mesamis
