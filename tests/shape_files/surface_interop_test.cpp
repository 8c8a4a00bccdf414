// SPDX-License-Identifier: Apache-2.0
// Our files in VTK's readers, VTK's files in ours.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPLYWriter.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLReader.h>
#include <vtkSTLWriter.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkStripper.h>
#include <vtkTypeInt64Array.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/extract.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

TriMesh sphere() {
  const TetMesh mesh = box_mesh({{-1, -1, -1}, {1, 1, 1}}, {12, 12, 12});
  std::vector<double> u;
  for (const Vec3& p : mesh.points) u.push_back(-norm(p));
  return extract_solid(mesh, u, -0.8);
}

vtkSmartPointer<vtkPolyData> vtk_sphere() {
  const TriMesh surface = sphere();
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (const Vec3& p : surface.points) points->InsertNextPoint(p.x, p.y, p.z);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const Triangle& t : surface.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

void expect_same(const TriMesh& found, const TriMesh& expected, double tolerance) {
  ASSERT_EQ(found.triangles.size(), expected.triangles.size());
  for (std::size_t t = 0; t < found.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 d =
          found.points[found.triangles[t][i]] - expected.points[expected.triangles[t][i]];
      ASSERT_LE(norm(d), tolerance) << t;
    }
  }
}

template <class Reader>
vtkSmartPointer<vtkPolyData> read_by_vtk(const std::filesystem::path& path) {
  const auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

void expect_same(vtkPolyData& found, const TriMesh& expected, double tolerance) {
  TriMesh surface;
  for (vtkIdType i = 0; i < found.GetNumberOfPoints(); ++i) {
    double p[3];
    found.GetPoint(i, p);
    surface.points.push_back({p[0], p[1], p[2]});
  }
  for (vtkIdType c = 0; c < found.GetNumberOfPolys(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    found.GetCellPoints(c, count, ids);
    ASSERT_EQ(count, 3);
    surface.triangles.push_back(
        {static_cast<Index>(ids[0]), static_cast<Index>(ids[1]), static_cast<Index>(ids[2])});
  }
  expect_same(surface, expected, tolerance);
}

TEST(SurfaceInterop, VtkReadsWhatWeWrite) {
  const TempFolder folder;
  const TriMesh surface = sphere();
  for (const char* extension : {"stl", "ply", "obj", "vtp"}) {
    write_surface(folder / (std::string("a.") + extension), surface, {.name = "a sphere"});
  }
  expect_same(*read_by_vtk<vtkSTLReader>(folder / "a.stl"), surface, 1e-7);
  expect_same(*read_by_vtk<vtkPLYReader>(folder / "a.ply"), surface, 1e-7);
  expect_same(*read_by_vtk<vtkOBJReader>(folder / "a.obj"), surface, 1e-7);
  expect_same(*read_by_vtk<vtkXMLPolyDataReader>(folder / "a.vtp"), surface, 0);
}

TEST(SurfaceInterop, VtpStatesFrameAndUnitInFieldData) {
  const TempFolder folder;
  for (const Frame frame : {Frame::kLps, Frame::kRas}) {
    write_surface(folder / "a.vtp", sphere(), {.frame = frame, .name = "left"});
    const auto data = read_by_vtk<vtkXMLPolyDataReader>(folder / "a.vtp");
    auto text = [&data](const char* name) {
      auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
      return array == nullptr ? std::string() : std::string(array->GetValue(0));
    };
    EXPECT_EQ(text("SPACE"), frame == Frame::kLps ? "LPS" : "RAS");
    EXPECT_EQ(text("LengthUnit"), "mm");
    EXPECT_EQ(text("Name"), "left");
  }
}

TEST(SurfaceInterop, WeReadEveryXmlThatVtkWrites) {
  const TempFolder folder;
  const TriMesh expected = sphere();
  const auto data = vtk_sphere();
  const auto writer = vtkSmartPointer<vtkXMLPolyDataWriter>::New();
  writer->SetInputData(data);
  writer->SetFileName((folder / "a.vtp").c_str());
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
    for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB}) {
      for (const int encode : {0, 1}) {
        for (const int header : {32, 64}) {
          for (const int order : {vtkXMLWriter::BigEndian, vtkXMLWriter::LittleEndian}) {
            writer->SetDataMode(mode);
            writer->SetCompressorType(compressor);
            writer->SetBlockSize(1000 * 24);  // several blocks, the last one smaller
            writer->SetEncodeAppendedData(encode);
            writer->SetHeaderType(header);
            writer->SetByteOrder(order);
            ASSERT_EQ(writer->Write(), 1);
            SCOPED_TRACE(testing::Message() << mode << ' ' << compressor << ' ' << encode << ' '
                                            << header << ' ' << order);
            expect_same(read_surface(folder / "a.vtp"), expected, 1e-9);  // ascii has few digits
          }
        }
      }
    }
  }
}

TEST(SurfaceInterop, AnUnknownCompressorIsRefusedByName) {
  const TempFolder folder;
  const auto writer = vtkSmartPointer<vtkXMLPolyDataWriter>::New();
  writer->SetInputData(vtk_sphere());
  writer->SetFileName((folder / "a.vtp").c_str());
  writer->SetCompressorTypeToLZMA();
  writer->Write();
  try {
    read_surface(folder / "a.vtp");
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("vtkLZMADataCompressor"), std::string::npos);
  }
}

TEST(SurfaceInterop, WeReadEveryLegacyFileThatVtkWrites) {
  const TempFolder folder;
  const TriMesh expected = sphere();
  const auto data = vtk_sphere();
  auto note = vtkSmartPointer<vtkTypeInt64Array>::New();
  note->SetName("a note");
  note->InsertNextValue(42);
  data->GetFieldData()->AddArray(note);
  data->SetVerts([] {
    auto verts = vtkSmartPointer<vtkCellArray>::New();
    verts->InsertNextCell({0});
    return verts;
  }());
  const auto writer = vtkSmartPointer<vtkPolyDataWriter>::New();
  writer->SetInputData(data);
  writer->SetFileName((folder / "a.vtk").c_str());
  for (const int type : {VTK_ASCII, VTK_BINARY}) {
    for (const int version : {42, 51}) {
      writer->SetFileType(type);
      writer->SetFileVersion(version);
      ASSERT_EQ(writer->Write(), 1);
      SCOPED_TRACE(testing::Message() << type << ' ' << version);
      expect_same(read_surface(folder / "a.vtk"), expected, 1e-5);  // ascii has few digits
    }
  }
}

TEST(SurfaceInterop, StripsKeepTheirOrientation) {
  const TempFolder folder;
  const auto stripper = vtkSmartPointer<vtkStripper>::New();
  stripper->SetInputData(vtk_sphere());
  const auto writer = vtkSmartPointer<vtkXMLPolyDataWriter>::New();
  writer->SetInputConnection(stripper->GetOutputPort());
  writer->SetFileName((folder / "a.vtp").c_str());
  writer->Write();
  const SurfaceCheck found = check_surface(read_surface(folder / "a.vtp"));
  EXPECT_TRUE(found.closed() && found.manifold());
  EXPECT_NEAR(found.volume, check_surface(sphere()).volume, 1e-12);
}

TEST(SurfaceInterop, WeReadStlAndPlyThatVtkWrites) {
  const TempFolder folder;
  const TriMesh expected = sphere();
  const auto stl = vtkSmartPointer<vtkSTLWriter>::New();
  const auto ply = vtkSmartPointer<vtkPLYWriter>::New();
  stl->SetInputData(vtk_sphere());
  ply->SetInputData(vtk_sphere());
  for (const int type : {VTK_ASCII, VTK_BINARY}) {
    stl->SetFileName((folder / "a.stl").c_str());
    stl->SetFileType(type);
    stl->Write();
    expect_same(read_surface(folder / "a.stl"), expected, 1e-5);
    for (const int order : {VTK_LITTLE_ENDIAN, VTK_BIG_ENDIAN}) {
      ply->SetFileName((folder / "a.ply").c_str());
      ply->SetFileType(type);
      ply->SetDataByteOrder(order);
      ply->Write();
      expect_same(read_surface(folder / "a.ply"), expected, 1e-5);
    }
  }
}

}  // namespace
}  // namespace mesamis
