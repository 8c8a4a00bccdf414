// SPDX-License-Identifier: Apache-2.0
// STL files: the ways to write them that are not ours, and how they go wrong.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>

#include "mesamis/shape_files/surface_files.h"
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

TEST(Stl, ReadsTextInAnyCaseAndBehindAMark) {
  const std::string text =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1e0 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid a\n";
  std::string upper = text;
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  std::string old_mac = text;
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  for (const std::string& bytes : {text, upper, old_mac, "\xef\xbb\xbf" + text, "\r\n  " + upper}) {
    const TempFolder folder;
    write_bytes(folder / "a.stl", bytes);
    EXPECT_EQ(read_surface(folder / "a.stl").triangles.size(), 1u) << bytes;
  }
}

TEST(Stl, BinaryThatBeginsWithSolidMayHaveBytesBehind) {
  const TempFolder folder;
  for (const std::string start : {"solid made elsewhere", "SOLID", "solid\n"}) {
    for (const char fill : {'\0', ' '}) {
      std::string bytes = start;
      bytes.resize(80, fill);
      bytes += bytes_of(std::uint32_t{1}) + std::string(12, '\0');
      bytes += bytes_of_all(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(2, '\0');
      write_bytes(folder / "a.stl", bytes + "colours of another program");
      EXPECT_EQ(read_surface(folder / "a.stl").triangles.size(), 1u) << start;
      write_bytes(folder / "a.stl", bytes.substr(0, bytes.size() - 1));
      EXPECT_REFUSED(read_surface(folder / "a.stl"), HasSubstr("promises 1 triangles"));
    }
  }
}

TEST(Stl, RefusesMoreTrianglesThanItsHeaderPromises) {
  const TempFolder folder;
  write_surface(folder / "a.stl", cube());
  std::string bytes = read_bytes(folder / "a.stl");
  for (const std::uint32_t count : {0u, 5u, 11u}) {
    bytes.replace(80, 4, bytes_of(count));
    write_bytes(folder / "a.stl", bytes);
    EXPECT_REFUSED(read_surface(folder / "a.stl"), HasSubstr("triangles, but more follow"));
  }
  bytes.replace(80, 4, bytes_of(12u));
  for (const std::string& behind : {std::string(500, '\0'), std::string(500, ' '),
                                    std::string(20, '\1') + std::string(30, '\xff')}) {
    write_bytes(folder / "a.stl", bytes + behind);
    EXPECT_EQ(read_surface(folder / "a.stl").triangles.size(), 12u);
  }
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

}  // namespace
}  // namespace mesamis
