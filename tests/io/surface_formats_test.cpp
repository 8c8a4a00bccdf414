// SPDX-License-Identifier: Apache-2.0
// What is particular to one format of surfaces: the ways to write it that are not ours, and how it
// goes wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "mesamis/io/surface_files.h"
#include "support/level_set.h"
#include "support/scan_bytes.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(Stl, HeaderIsNeverTakenForText) {
  const TempFolder folder;
  write_surface(folder / "a.stl", cube(), {.name = std::string(200, 'n')});
  const std::string bytes = read_bytes(folder / "a.stl");
  EXPECT_EQ(bytes.size(), 84u + 12 * 50);
  EXPECT_NE(bytes.substr(0, 5), "solid");
}

TEST(Stl, StaysClosedWhereVoxelsAreRoundingErrors) {
  TempFolder folder;
  TriMesh surface = level_set({{-1, -1, -1}, {1, 1, 1}}, {24, 24, 24},
                              [](const Vec3& p) { return 0.8 - norm(p); });
  for (Vec3& p : surface.points) p = Vec3{1e5, -1e5, 1e5} + 0.1 * p;
  write_surface(folder / "a.stl", surface);
  const SurfaceCheck check = check_surface(read_surface(folder / "a.stl"));
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_EQ(check.components, 1);
}

TEST(Stl, BinaryThatBeginsWithSolidIsReadBySize) {
  const TempFolder folder;
  write_surface(folder / "a.stl", cube());
  std::string bytes = read_bytes(folder / "a.stl");
  bytes.replace(0, 9, "solid bad");
  write_bytes(folder / "a.stl", bytes);
  EXPECT_EQ(read_surface(folder / "a.stl").triangles.size(), 12u);
}

TEST(Stl, ReadsText) {
  const TempFolder folder;
  const std::string text =
      "solid two\r\n facet normal 0 0 1\r\n  outer loop\r\n   vertex 0 0 -0\r\n"
      "   vertex 1.5e1 0 0\r\n   VERTEX 0 +2 0\r\n  endloop\r\n endfacet\r\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 2 0\nvertex 0 0 1\nendloop\n"
      "endfacet\nendsolid two\n";
  write_bytes(folder / "a.stl", text);
  const TriMesh surface = read_surface(folder / "a.stl");
  EXPECT_EQ(surface.points.size(), 4u);  // 0 and -0 are equal
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(surface.points[1], (Vec3{15, 0, 0}));
  write_bytes(folder / "b.stl", text.substr(0, text.find("endsolid")));
  EXPECT_REFUSED(read_surface(folder / "b.stl"), HasSubstr("endsolid"));
  write_bytes(folder / "c.stl", "solid x\nvertex 1 2\nendsolid\n");
  EXPECT_REFUSED(read_surface(folder / "c.stl"), HasSubstr("line 2"));
}

TEST(Stl, LeavesOutWhatSinglePrecisionCollapses) {
  const TempFolder folder;
  TriMesh surface = cube({1000, 0, 0});
  // Triangle 0 is cut into three by two points on its side, 1e-9 mm apart.
  const Triangle t = surface.triangles[0];
  const Vec3 middle = 0.5 * (surface.points[t[0]] + surface.points[t[1]]);
  surface.points.push_back(middle);
  surface.points.push_back(middle + Vec3{0, 1e-9, 0});
  surface.triangles[0] = {t[0], 8, t[2]};
  surface.triangles.push_back({8, 9, t[2]});
  surface.triangles.push_back({9, t[1], t[2]});
  write_surface(folder / "a.stl", surface);
  const TriMesh read = read_surface(folder / "a.stl");
  EXPECT_EQ(read.triangles.size(), surface.triangles.size() - 1);
  EXPECT_EQ(check_surface(read).degenerate_triangles, 0);
}

TEST(Stl, PromisingMoreThanTheFileHoldsIsRefused) {
  const TempFolder folder;
  write_surface(folder / "a.stl", cube());
  std::string bytes = read_bytes(folder / "a.stl");
  bytes.replace(80, 4, "\xff\xff\xff\xff");
  write_bytes(folder / "a.stl", bytes);
  EXPECT_REFUSED(read_surface(folder / "a.stl"),
                 testing::AllOf(HasSubstr("4294967295"), HasSubstr("after 12")));
}

TEST(Stl, NotANumberIsRefused) {
  const TempFolder folder;
  write_bytes(folder / "a.stl",
              "solid\nvertex nan 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendsolid\n");
  EXPECT_REFUSED(read_surface(folder / "a.stl"), HasSubstr("finite"));
}

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

TEST(Obj, ReadsAllWaysToNamePoints) {
  const TempFolder folder;
  write_bytes(
      folder / "a.obj",
      "# by hand\r\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 .5 .5 .5\nvt 0 0\nvn 0 0 1\n"
      "v 0 1 0\nf 1/1/1 2//1 3/1 4\ns off\nf -4 -3 -1\n");
  const TriMesh surface = read_surface(folder / "a.obj");
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
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

constexpr const char* kTextVtk =
    "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n"
    "0 0 0 1 0 0 1 1 0 0 1 0 0 0 2\nLINES 1 3\n2 0 4\nPOLYGONS 2 9\n4 0 1 2 3\n3 0 1 4\n"
    "TRIANGLE_STRIPS 1 5\n4 0 1 3 2\n";

TEST(Vtk, ReadsPolygonsAndStrips) {
  const TempFolder folder;
  write_bytes(folder / "a.vtk", kTextVtk);
  const TriMesh surface = read_surface(folder / "a.vtk");
  EXPECT_EQ(surface.points.size(), 5u);
  EXPECT_EQ(surface.triangles,
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {0, 1, 3}, {1, 2, 3}}));
  write_bytes(folder / "b.vtk.gz", packed(kTextVtk));
  EXPECT_EQ(read_surface(folder / "b.vtk.gz").triangles, surface.triangles);
}

TEST(Vtk, RefusesWhatContradictsItself) {
  const TempFolder folder;
  const std::vector<std::array<std::string, 2>> cases{
      {"POINTS 5", "POINTS 5000000000"}, {"POINTS 5", "POINTS -5"},
      {"POINTS 5", "POINTS 4"},          {"POLYGONS 2 9", "POLYGONS 2000000 9000000"},
      {"4 0 1 2 3", "4 0 1 2 9"},        {"4 0 1 2 3", "4 0 1 2 -3"},
      {"4 0 1 2 3", "900 0 1 2 3"},      {"4 0 1 2 3", "-4 0 1 2 3"},
      {"POLYDATA", "UNSTRUCTURED_GRID"}, {"# vtk", "# not"}};
  for (const auto& [from, to] : cases) {
    std::string text = kTextVtk;
    text.replace(text.find(from), from.size(), to);
    write_bytes(folder / "a.vtk", text);
    EXPECT_REFUSED(read_surface(folder / "a.vtk"), HasSubstr("a.vtk: ")) << to;
  }
}

TEST(Vtk, CutOffOrDamagedItIsRefusedOrStillASurface) {
  const TempFolder folder;
  const std::string whole = kTextVtk;
  std::mt19937 generator(3);
  for (std::size_t round = 0; round < whole.size() + 300; ++round) {
    std::string bytes = whole.substr(0, round);
    if (round > whole.size()) bytes[generator() % bytes.size()] = static_cast<char>(generator());
    write_bytes(folder / "a.vtk", bytes);
    try {
      check_surface(read_surface(folder / "a.vtk"));
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    }
  }
}

TEST(Vtp, PromisingMoreThanTheFileHoldsIsRefused) {
  const TempFolder folder;
  write_surface(folder / "a.vtp", cube());
  const std::string whole = read_bytes(folder / "a.vtp");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"NumberOfPoints=\"8\"", "NumberOfPoints=\"80000000000\""},
           {"NumberOfPoints=\"8\"", "NumberOfPoints=\"9\""},
           {"NumberOfPolys=\"12\"", "NumberOfPolys=\"13\""},
           {"NumberOfPolys=\"12\"", "NumberOfPolys=\"-1\""},
           {"PolyData", "NolyData"}}) {
    std::string bytes = whole;
    bytes.replace(bytes.find(from), from.size(), to);
    write_bytes(folder / "a.vtp", bytes);
    EXPECT_REFUSED(read_surface(folder / "a.vtp"), HasSubstr("a.vtp: ")) << to;
  }
}

TEST(Vtp, ArraysOnItsPointsAreReadBackByName) {
  const TempFolder folder;
  const TriMesh surface = cube();
  const std::vector<double> values{0.5, -1, 1e-300, 3, 4, 5, 6, 1.0 / 3};
  write_surface(folder / "a.vtp", surface, {.point_arrays = {{"one", values}, {"two", values}}});
  EXPECT_EQ(read_point_array(folder / "a.vtp", "two"), values);
  EXPECT_REFUSED(read_point_array(folder / "a.vtp", "three"), HasSubstr("there is one, two"));
  write_surface(folder / "b.vtp", surface);
  EXPECT_REFUSED(read_point_array(folder / "b.vtp", "one"), HasSubstr("there is none"));
  write_surface(folder / "c.ply", surface);
  EXPECT_REFUSED(read_point_array(folder / "c.ply", "one"), HasSubstr("only .vtp"));
  EXPECT_REFUSED(write_surface(folder / "d.vtp", surface, {.point_arrays = {{"short", {1, 2}}}}),
                 HasSubstr("per point (8), found 2"));
  EXPECT_REFUSED(write_surface(folder / "d.vtp", surface,
                               {.point_arrays = {{"x", std::vector<double>(8, std::nan(""))}}}),
                 HasSubstr("not finite"));
  EXPECT_FALSE(std::filesystem::exists(folder / "d.vtp"));
}

}  // namespace
}  // namespace mesamis
