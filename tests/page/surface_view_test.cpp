// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/surface_view.h"

#include <gtest/gtest.h>

#include <numbers>

#include "page/unpacked.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace mesamis {
namespace {

constexpr Colour kRed{200, 0, 0}, kBlue{0, 0, 200}, kWhite{255, 255, 255};

double covered(const Raster& picture) {
  int count = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) count += pixel(picture, x, y) != kWhite;
  }
  return static_cast<double>(count) / (picture.width * picture.height);
}

TEST(SurfaceView, OfABallIsADisc) {
  const TriMesh ball = ball_surface(10, 64);
  for (const std::string& view : surface_views()) {
    const Raster picture =
        surface_view(std::vector<ShownSurface>{{&ball, "", kRed, {}}}, view, 200);
    EXPECT_NEAR(covered(picture), std::numbers::pi / 4 / (1.06 * 1.06), 0.02) << view;
    EXPECT_EQ(pixel(picture, 1, 1), kWhite);
  }
}

TEST(SurfaceView, ShowsWhatIsNearest) {
  // Blue lies in front of red (anterior), to the patient's left of it, and below.
  const TriMesh red = cube({0, 0, 0}, 10), blue = cube({6, -20, -6}, 10);
  const std::vector<ShownSurface> both{{&red, "", kRed, {}}, {&blue, "", kBlue, {}}};
  const Raster front = surface_view(both, "front", 160);
  const auto is_blue = [](const Colour& c) { return c[2] > c[0]; };
  EXPECT_TRUE(is_blue(pixel(front, front.width / 2, front.height / 2))) << "where they overlap";
  EXPECT_TRUE(is_blue(pixel(front, front.width - 12, front.height - 12))) << "left is on the right";
  EXPECT_FALSE(is_blue(pixel(front, 12, 12)));
  const Raster top = surface_view(both, "top", 160);
  EXPECT_TRUE(is_blue(pixel(top, top.width / 2 - 25, 12))) << "from above the front is up";
}

TEST(SurfaceView, OfASinglePointIsWhite) {
  const TriMesh point{{{1, 2, 3}}, {}};
  EXPECT_EQ(covered(surface_view(std::vector<ShownSurface>{{&point, "", kRed, {}}}, "left", 32)),
            0);
}

}  // namespace
}  // namespace mesamis
