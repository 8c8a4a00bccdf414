// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/mesh_cut.h"

#include <gtest/gtest.h>

#include "mesamis/mesh/tet_mesh.h"
#include "page/unpacked.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

int brightness(const Colour& c) { return c[0] + c[1] + c[2]; }

TEST(MapColour, GetsLighterAllTheWay) {
  for (int grey = 1; grey < 256; ++grey) {
    EXPECT_GE(brightness(map_colour(grey)), brightness(map_colour(grey - 1)) - 1) << grey;
  }
  EXPECT_EQ(map_colour(-50), map_colour(0));
  EXPECT_EQ(map_colour(900), map_colour(255));
}

TEST(MeshCut, ShowsTheGreyValuesOfTheCellsItMeets) {
  const Volume scan = sampled_volume({21, 21, 21}, {1, 1, 1}, [](const Vec3& p) { return p.x; });
  const TetMesh mesh = box_mesh({{0, 0, 0}, {10, 20, 20}}, {2, 2, 3});
  std::vector<double> grey;
  for (const Vec3& p : mesh.points) grey.push_back(25.5 * p.x);
  const double position = 7;
  const SlicePlane plane = slice_plane(scan, 2, &position);
  const Raster cut = mesh_cut({&mesh, grey}, scan, plane, {{0, 20, -20, 0}, 200});
  ASSERT_EQ(cut.width, 200);
  ASSERT_EQ(cut.height, 200);
  EXPECT_EQ(pixel(cut, 150, 100), (Colour{255, 255, 255})) << "no cell is there";
  // Linear to the right, away from edges of cells.
  for (const int x : {12, 31, 88}) {
    const Colour expected = map_colour(255.0 * (x + 0.5) / 100), found = pixel(cut, x, 73);
    EXPECT_NEAR(brightness(found), brightness(expected), 6) << x;
  }
  int dark = 0;
  for (int x = 0; x < 100; ++x) {
    dark += brightness(pixel(cut, x, 73)) < 0.85 * brightness(map_colour(255.0 * (x + 0.5) / 100));
  }
  EXPECT_GT(dark, 0) << "edges are drawn";
}

TEST(RegionAround, IsATenthWiderThanTheOutlinesAndWithinTheSlice) {
  const PageBox all{0, 100, 0, 100};
  const PageBox region = region_around({{{{20, 95}, {40, 55}}}}, all);
  EXPECT_DOUBLE_EQ(region.left, 16);
  EXPECT_DOUBLE_EQ(region.right, 44);
  EXPECT_DOUBLE_EQ(region.top, 99);
  EXPECT_DOUBLE_EQ(region.bottom, 51);
  EXPECT_DOUBLE_EQ(region_around({}, all).width(), 100);
}

}  // namespace
}  // namespace mesamis
