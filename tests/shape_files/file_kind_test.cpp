// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/file_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/shape_files/surface_files.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

TEST(KindOf, GoesByTheExtension) {
  for (const char* name : {"a.stl", "a.PLY", "a.b.obj", "dir/a.vtp", "a.3mf", "a.amf", "a.vtk"}) {
    EXPECT_EQ(kind_of(name), FileKind::kSurface) << name;
  }
  for (const char* name : {"a.vtu", "a.mesh", "a.Mesh", "a.mesh.gz"}) {
    EXPECT_EQ(kind_of(name), FileKind::kMesh) << name;
  }
  for (const char* name : {"a.nrrd", "a.nii.gz", "a", "stl", ".stl", "a.gz", "a.stl.nii", ""}) {
    EXPECT_EQ(kind_of(name), FileKind::kVolume) << name;
  }
  EXPECT_EQ(kind_of("a.stl.gz"), FileKind::kSurface);
}

TEST(KindOf, EveryFormatThatIsWrittenIsASurface) {
  for (const std::string& extension : written_surface_formats()) {
    const bool dicom = extension.ends_with(".dcm");  // only the content tells
    EXPECT_EQ(kind_of("a" + extension), dicom ? FileKind::kVolume : FileKind::kSurface)
        << extension;
  }
}

TEST(KindOf, ADirectoryMayBeAScan) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "series.stl");
  EXPECT_EQ(kind_of(folder / "series.stl"), FileKind::kVolume);
}

TEST(ReadMesh, ReadsWhatWasWritten) {
  const TempFolder folder;
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 2, 3}}, {2, 2, 3});
  const std::vector<MeshArray> arrays{{"a", 1, std::vector<double>(mesh.points.size(), 7)}};
  write_medit_mesh(folder / "a.MESH", mesh);
  write_vtu(folder / "a.vtu", mesh, {.point_arrays = arrays});
  for (const char* name : {"a.MESH", "a.vtu"}) {
    const MeshWithArrays read = read_mesh(folder / name);
    EXPECT_EQ(read.mesh.points, mesh.points) << name;
    EXPECT_EQ(read.mesh.cells, mesh.cells) << name;
  }
  EXPECT_TRUE(read_mesh(folder / "a.MESH").point_arrays.empty());
  EXPECT_EQ(read_mesh(folder / "a.vtu").point_arrays.at(0).values, arrays[0].values);
}

TEST(ReadMesh, RefusesAnythingElse) {
  const TempFolder folder;
  write_bytes(folder / "a.nrrd", "NRRD0004");
  EXPECT_REFUSED(read_mesh(folder / "a.nrrd"), testing::HasSubstr("a.nrrd"));
  EXPECT_REFUSED(read_mesh(folder / "none.mesh"), testing::HasSubstr("none.mesh"));
}

}  // namespace
}  // namespace mesamis
