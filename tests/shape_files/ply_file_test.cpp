// SPDX-License-Identifier: Apache-2.0
// PLY files of other writers, and damaged ones.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "mesamis/shape_files/surface_files.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr const char* kTextPly =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 5\nproperty uchar red\n"
    "property float x\nproperty float y\nproperty float z\nelement edge 1\nproperty int vertex1\n"
    "property int vertex2\nelement face 2\nproperty list uchar float weights\n"
    "property list uchar uint vertex_index\nend_header\n"
    "9 0 0 0\n9 1 0 0\n9 1 1 0\n9 0 1 0\n9 0 0 2\n0 1\n"
    "2 0.5 0.25 4 0 1 2 3\n0 3 0 1 4\n";

TEST(Ply, ReadsTextWithMoreThanItNeeds) {
  const TempFolder folder;
  write_bytes(folder / "a.ply", kTextPly);
  const TriMesh surface = read_surface(folder / "a.ply");
  EXPECT_EQ(surface.points.size(), 5u);
  EXPECT_EQ(surface.points[4], (Vec3{0, 0, 2}));
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}}));
}

/// The first value of the second file looks like the end of a line.
TEST(Ply, LinesMayEndAsOnOldMacs) {
  const TempFolder folder;
  std::string text = kTextPly;
  std::replace(text.begin(), text.end(), '\n', '\r');
  write_bytes(folder / "a.ply", text);
  EXPECT_EQ(read_surface(folder / "a.ply").triangles.size(), 3u);
  write_bytes(folder / "b.ply",
              "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty uchar x\r"
              "property uchar y\rproperty uchar z\relement face 1\r"
              "property list uchar uchar vertex_indices\rend_header\r" +
                  std::string("\n\0\0\0\1\0\0\0\1\3\0\1\2", 13));
  const TriMesh surface = read_surface(folder / "b.ply");
  EXPECT_EQ(surface.points, (std::vector<Vec3>{{10, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Ply, ArraysOnItsPointsAreReadBackByName) {
  const TempFolder folder;
  const TriMesh surface{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const std::vector<double> one{0.5, -1, 1e-300}, two{3, 4, 1.0 / 3};
  write_surface(folder / "a.ply", surface, {.point_arrays = {{"one", one}, {"two", two}}});
  EXPECT_EQ(read_surface(folder / "a.ply").points, surface.points);
  EXPECT_EQ(read_surface(folder / "a.ply").triangles, surface.triangles);
  EXPECT_EQ(read_point_array(folder / "a.ply", "one"), one);
  EXPECT_EQ(read_point_array(folder / "a.ply", "two"), two);
  EXPECT_REFUSED(read_point_array(folder / "a.ply", "three"), HasSubstr("there is x, y, z, one"));
  write_bytes(folder / "b.ply", kTextPly);
  EXPECT_EQ(read_point_array(folder / "b.ply", "red"), std::vector<double>(5, 9));
  write_bytes(folder / "b.ply", std::string(kTextPly).substr(0, 300));
  EXPECT_REFUSED(read_point_array(folder / "b.ply", "red"), HasSubstr("b.ply"));
}

TEST(Ply, ReadsBigEndian) {
  const TempFolder folder;
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty int8 y\n"
      "property ushort z\nelement face 1\nproperty list ushort short vertex_indices\nend_header\n";
  const unsigned char data[] = {1,    0,    0,    0, 5,  // (256, 0, 5)
                                0xff, 0xff, 3,    0, 0,  // (-1, 3, 0)
                                0,    0,    0xfe, 1, 0,  // (0, -2, 256)
                                0,    3,    0,    0, 0, 1, 0, 2};
  bytes.append(reinterpret_cast<const char*>(data), sizeof data);
  write_bytes(folder / "a.ply", bytes);
  const TriMesh surface = read_surface(folder / "a.ply");
  EXPECT_EQ(surface.points, (std::vector<Vec3>{{256, 0, 5}, {-1, 3, 0}, {0, -2, 256}}));
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Ply, RefusesWhatContradictsItself) {
  const TempFolder folder;
  const std::vector<std::array<std::string, 3>> cases{
      {"vertex 5", "vertex 5000000000000", "ends before"},
      {"vertex 5", "vertex -5", "expected a count"},
      {"vertex 5", "vertex", "expected a count"},
      {"float x", "float a", "x, y and z"},
      {"float x", "quad x", "type of a property"},
      {"ascii", "base64", "binary_big_endian"},
      {"end_header", "comment", "no end"},
      {"4 0 1 2 3", "4 0 1 2 7", "names point 7"},
      {"4 0 1 2 3", "4 0 1 2 -1", "found -1"},
      {"4 0 1 2 3", "4 0 1 2 1.5", "found 1.5"},
      {"4 0 1 2 3", "99999 0 1 2 3", "99999 entries"},
      {"0 0 2\n", "0 0 two\n", "\"two\""},
      {"0 0 2\n", "0 0 inf\n", "finite"},
      {"element face 2", "element face 0", "no triangle"}};
  for (const auto& [from, to, message] : cases) {
    std::string text = kTextPly;
    text.replace(text.find(from), from.size(), to);
    write_bytes(folder / "a.ply", text);
    EXPECT_REFUSED(read_surface(folder / "a.ply"), HasSubstr(message)) << to;
  }
}

}  // namespace
}  // namespace mesamis
