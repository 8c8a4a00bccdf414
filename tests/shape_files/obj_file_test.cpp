// SPDX-License-Identifier: Apache-2.0
// OBJ files of other writers, and damaged ones.
#include <gmock/gmock.h>

#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "shape_files/object_example.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(Obj, ReadsAllWaysToNamePoints) {
  const TempFolder folder;
  write_bytes(
      folder / "a.obj",
      "# by hand\r\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 .5 .5 .5\nvt 0 0\nvn 0 0 1\n"
      "v 0 1 0\nf 1/1/1 2//1 3/1 4\ns off\nf -4 -3 -1\n");
  const TriMesh surface = read_surface(folder / "a.obj");
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
}

TEST(Obj, LinesMayEndAsOnOldMacsOrGoOnBehindABackslash) {
  const TempFolder folder;
  write_bytes(folder / "a.obj", "# by hand\rv 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r");
  EXPECT_EQ(read_surface(folder / "a.obj").triangles, (std::vector<Triangle>{{0, 1, 2}}));
  write_bytes(folder / "a.obj", "v 0 0 0\nv 1 0\\\n0\nv 0 1 0\nf 1 \\\r\n 2\\\n3\n");
  EXPECT_EQ(read_surface(folder / "a.obj").triangles, (std::vector<Triangle>{{0, 1, 2}}));
  write_bytes(folder / "a.obj", "v 0 0 0\nv 1 0\\\n0\nv 0 1 x\nf 1 2 \\");
  EXPECT_REFUSED(read_surface(folder / "a.obj"), HasSubstr("line 4"));
}

TEST(Obj, SaysInWhichLineItIsWrong) {
  const TempFolder folder;
  for (const auto& [text, message] :
       std::vector<std::pair<std::string, std::string>>{{"v 1 2\n", "line 1"},
                                                        {"v 0 0 0\nf 1 1 0\n", "line 2"},
                                                        {"v 0 0 0\nf 1 -2 1\n", "line 2"},
                                                        {"v 0 0 0\nf 1 1\n", "at least 3"},
                                                        {"v 0 0 0\nf 1 1 x\n", "\"x\""},
                                                        {"v 0 0 0\nf 1 1 2\n", "names point 1"},
                                                        {"v 0 0 0\n", "no triangle"}}) {
    write_bytes(folder / "a.obj", text);
    EXPECT_REFUSED(read_surface(folder / "a.obj"), HasSubstr(message)) << text;
  }
}

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Shared points, groups in several places, materials that stay until the next one.
TEST(Obj, GroupsAreObjectsWhereThereIsNoO) {
  const TempFolder folder;
  write_bytes(folder / "m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  write_bytes(folder / "a.obj", std::string("mtllib m.mtl\nmtllib other.mtl\n") + kSquare +
                                    "g empty\ng left hip\nusemtl red\nf 1 2 3\n"
                                    "g right\nusemtl blue\nf 3 4 1\ng left hip\nf 2 3 4\n");
  const ObjectFile file = read_object_file(folder / "a.obj");
  ASSERT_EQ(file.objects.size(), 2u);
  const NamedSurface &left = file.objects[0], &right = file.objects[1];
  EXPECT_EQ(left.name, "left hip");
  EXPECT_EQ(left.label, 1);
  EXPECT_EQ(left.colour, (std::array<std::uint8_t, 3>{255, 0, 0}));
  EXPECT_EQ(left.surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}}));
  EXPECT_EQ(right.label, 2);
  EXPECT_EQ(right.colour, (std::array<std::uint8_t, 3>{0, 0, 255}));
  EXPECT_EQ(right.surface.points, (std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(right.surface.triangles, (std::vector<Triangle>{{1, 2, 0}}));
  EXPECT_TRUE(file.coloured);
  EXPECT_EQ(read_surface(folder / "a.obj").points.size(), 4u);
}

TEST(Obj, FacesBeforeAnyNameAreAnObjectToo) {
  const TempFolder folder;
  write_bytes(folder / "a.obj",
              kSquare + std::string("f 1 2 3\no b\n# label 1\ng part\nf 1 3 4\n"));
  const ObjectFile file = read_object_file(folder / "a.obj");
  ASSERT_EQ(file.objects.size(), 2u);
  EXPECT_EQ(file.objects[0].name, "object 1");
  EXPECT_EQ(file.objects[1].name, "b");
  EXPECT_EQ(file.objects[1].label, 2) << "the first has no label: both are counted";
  EXPECT_FALSE(file.coloured);
}

TEST(Obj, MaterialsAreReadFromItsOwnFolderOnly) {
  const TempFolder folder;
  write_bytes(folder / "up.mtl", "newmtl a\nKd 1 0 0\n");
  write_bytes(folder / "bad.mtl", "newmtl a\nKd red\n");
  const auto coloured = [&](const std::string& library) {
    write_bytes(folder / "a.obj", "mtllib " + library + "\n" + kSquare + "usemtl a\nf 1 2 3\n");
    return read_object_file(folder / "a.obj").coloured;
  };
  EXPECT_TRUE(coloured("up.mtl"));
  EXPECT_FALSE(coloured("none.mtl"));
  EXPECT_FALSE(coloured("../" + folder.path().filename().string() + "/up.mtl"));
  EXPECT_FALSE(coloured(folder / "up.mtl"));
  EXPECT_FALSE(coloured(".."));
  EXPECT_REFUSED(coloured("bad.mtl"), HasSubstr("bad.mtl: line 2"));
  EXPECT_EQ(read_surface(folder / "a.obj").triangles.size(), 1u) << "without materials";
}

TEST(Obj, AndItsMaterialsAppearTogetherOrNotAtAll) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "a.mtl");
  EXPECT_REFUSED(write_objects(folder / "a.obj", three_objects()), HasSubstr("cannot be written"));
  EXPECT_REFUSED(write_objects(folder / "two\nlines.obj", three_objects()), HasSubstr("one line"));
  EXPECT_EQ(folder.file_count(), 1);
  write_objects(folder / "b c.obj", three_objects());
  EXPECT_EQ(folder.file_count(), 3);
  EXPECT_TRUE(read_object_file(folder / "b c.obj").coloured);
}

}  // namespace
}  // namespace mesamis
