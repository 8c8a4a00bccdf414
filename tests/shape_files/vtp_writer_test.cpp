// SPDX-License-Identifier: Apache-2.0
// Files of several objects in VTK's reader, and other ones in ours.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include "shape_files/object_example.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

vtkSmartPointer<vtkPolyData> read_by_vtk(const std::filesystem::path& path) {
  const auto reader = vtkSmartPointer<vtkXMLPolyDataReader>::New();
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST(VtpWriter, VtkFindsLabelsColoursAndNames) {
  const TempFolder folder;
  const std::vector<NamedSurface> objects = three_objects();
  write_objects(folder / "a.vtp", objects, {.name = "pelvis"});
  const auto data = read_by_vtk(folder / "a.vtp");
  ASSERT_EQ(data->GetNumberOfPolys(), 36);
  vtkCellData& cells = *data->GetCellData();
  auto* labels = vtkIntArray::SafeDownCast(cells.GetArray("label"));
  auto* colours = vtkUnsignedCharArray::SafeDownCast(cells.GetScalars());
  ASSERT_TRUE(labels != nullptr && colours != nullptr);
  EXPECT_STREQ(colours->GetName(), "RGB");
  ASSERT_EQ(colours->GetNumberOfComponents(), 3);
  for (vtkIdType t = 0; t < 36; ++t) {
    const NamedSurface& object = objects[static_cast<std::size_t>(t / 12)];
    EXPECT_EQ(labels->GetValue(t), object.label);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(colours->GetTypedComponent(t, c), object.colour[static_cast<std::size_t>(c)]);
    }
  }
  vtkFieldData& fields = *data->GetFieldData();
  auto* numbers = vtkIntArray::SafeDownCast(fields.GetArray("ObjectLabels"));
  auto* names = vtkStringArray::SafeDownCast(fields.GetAbstractArray("ObjectNames"));
  ASSERT_TRUE(numbers != nullptr && names != nullptr);
  ASSERT_EQ(names->GetNumberOfValues(), 3);
  for (vtkIdType i = 0; i < 3; ++i) {
    EXPECT_EQ(numbers->GetValue(i), objects[static_cast<std::size_t>(i)].label);
    EXPECT_EQ(std::string(names->GetValue(i)), objects[static_cast<std::size_t>(i)].name);
  }
}

/// A file of VTK's own: a line before the polygons, quadrangles, labels as another type.
vtkSmartPointer<vtkPolyData> by_hand() {
  auto points = vtkSmartPointer<vtkPoints>::New();
  for (int i = 0; i < 6; ++i) points->InsertNextPoint(i % 3, i / 3, 0);
  auto lines = vtkSmartPointer<vtkCellArray>::New();
  lines->InsertNextCell({0, 1});
  auto polygons = vtkSmartPointer<vtkCellArray>::New();
  polygons->InsertNextCell({0, 1, 4, 3});
  polygons->InsertNextCell({1, 2, 4});
  polygons->InsertNextCell({2, 5, 4});
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->SetPolys(polygons);
  return data;
}

void add_labels(vtkPolyData& data, const std::vector<double>& values) {
  auto labels = vtkSmartPointer<vtkDoubleArray>::New();
  labels->SetName("label");
  for (const double value : values) labels->InsertNextValue(value);
  data.GetCellData()->AddArray(labels);
}

std::vector<NamedSurface> objects_in(vtkPolyData& data, const std::filesystem::path& path) {
  const auto writer = vtkSmartPointer<vtkXMLPolyDataWriter>::New();
  writer->SetInputData(&data);
  writer->SetFileName(path.c_str());
  writer->Write();
  return read_objects(path);
}

TEST(VtpWriter, OtherWritersLabelsDivideTheCells) {
  const TempFolder folder;
  const auto data = by_hand();
  add_labels(*data, {9, 4, 1, 4});
  const auto objects = objects_in(*data, folder / "a.vtp");
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].label, 4);
  EXPECT_EQ(objects[0].name, "object 4");
  EXPECT_EQ(objects[0].surface.triangles, (std::vector<Triangle>{{0, 1, 4}, {0, 4, 3}, {2, 5, 4}}));
  EXPECT_EQ(objects[1].label, 1);
  EXPECT_EQ(objects[1].surface.points, (std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(objects[1].surface.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(VtpWriter, ValuesThatAreNoLabelsDivideNothing) {
  const TempFolder folder;
  const auto data = by_hand();
  add_labels(*data, {0, 0.5, -1, 3});
  EXPECT_EQ(objects_in(*data, folder / "a.vtp").size(), 1u);
}

TEST(VtpWriter, DamagedLabelsAreRefused) {
  const TempFolder folder;
  write_objects(folder / "a.vtp", three_objects());
  const std::string whole = read_bytes(folder / "a.vtp");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bytes = whole;
    bytes.replace(bytes.find(from), from.size(), to);
    write_bytes(folder / "a.vtp", bytes);
    return read_objects(folder / "a.vtp");
  };
  EXPECT_REFUSED(with("NumberOfLines=\"0\"", "NumberOfLines=\"7\""), HasSubstr("\"label\""));
  EXPECT_REFUSED(with("NumberOfVerts=\"0\" ", "NumberOfVerts=\"9999999999\""),
                 HasSubstr("expected at most 2147483647 verts"));
  EXPECT_REFUSED(
      with("type=\"Int32\" Name=\"ObjectLabels\"", "type=\"Int16\" Name=\"ObjectLabels\""),
      HasSubstr("expected 3 values in the array \"ObjectLabels\", found 6"));
  EXPECT_REFUSED(
      with("type=\"Int32\" Name=\"ObjectLabels\"", "type=\"Float32\" Name=\"ObjectLabels\""),
      HasSubstr("expected labels of objects"));
  EXPECT_EQ(with("Name=\"label\"", "Name=\"lebal\"").size(), 1u);
  EXPECT_EQ(with("Name=\"ObjectNames\"", "Name=\"ObjectGames\"")[2].name, "object 300");
}

}  // namespace
}  // namespace mesamis
