// SPDX-License-Identifier: Apache-2.0
// Legacy VTK files, which are read alone.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <random>

#include "mesamis/shape_files/surface_files.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

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
  std::string old_mac = kTextVtk;
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  write_bytes(folder / "c.vtk", old_mac);
  EXPECT_EQ(read_surface(folder / "c.vtk").triangles, surface.triangles);
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

}  // namespace
}  // namespace mesamis
