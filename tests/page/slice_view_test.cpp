// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/slice_view.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "page/unpacked.h"
#include "support/sampled_volume.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

/// x to the left, y to the back, z to the head; brighter to the left.
Volume ramp() {
  return sampled_volume({11, 21, 31}, {2, 1, 1}, [](const Vec3& p) { return p.x; });
}

TEST(SliceView, LiesAsRadiologistsLookAtIt) {
  const Volume scan = ramp();
  const TriMesh box = cube({4, 4, 4}, 6);
  const std::vector<ShownSurface> shown{{&box, "box", {1, 2, 3}, {255, 140, 26}}};
  const SliceView axial = slice_view(scan, shown, 2, {0, 20});
  EXPECT_EQ(axial.name, "axial");
  EXPECT_EQ(axial.voxels.width, 11);
  EXPECT_EQ(axial.voxels.height, 21);
  EXPECT_EQ(pixel(axial.voxels, 0, 0)[0], 0) << "the patient's right is on the left";
  EXPECT_EQ(pixel(axial.voxels, 10, 0)[0], 255);
  EXPECT_NEAR(axial.box.width(), 22, 1e-12) << "with the halves of the voxels at the border";
  EXPECT_NEAR(axial.box.height(), 21, 1e-12);
  ASSERT_EQ(axial.outlines.size(), 1u);
  ASSERT_EQ(axial.outlines[0].size(), 1u);
}

TEST(SliceView, IsTheMiddleOneWhereTheSurfaceIsElsewhere) {
  const Volume scan = ramp();
  const TriMesh box = cube({400, 400, 400}, 6);
  const std::vector<ShownSurface> shown{{&box, "", {}, {}}};
  EXPECT_EQ(plane_through(scan, shown, 2).index, 15);
  EXPECT_EQ(plane_through(scan, {}, 2).index, 15);
}

TEST(SliceSvg, HoldsThePictureTheOutlineAndTheSides) {
  const Volume scan = ramp();
  const TriMesh box = cube({4, 4, 4}, 6);
  const std::vector<ShownSurface> shown{{&box, "<b>", {1, 2, 3}, {255, 140, 26}}};
  const std::string svg = slice_svg(slice_view(scan, shown, 0, {0, 20}), shown);
  for (const char* part : {"href=\"data:image/png;base64,", "stroke=\"#ff8c1a\"", ">A<", ">P<",
                           ">S<", ">I<", " mm</text>", "aria-label=\"sagittal slice"}) {
    EXPECT_THAT(svg, testing::HasSubstr(part));
  }
  EXPECT_THAT(svg, testing::Not(testing::HasSubstr("<b>")));
}

TEST(ThinLine, StaysWithinItsStep) {
  PageLine circle;
  constexpr int kPoints = 5000;
  for (int n = 0; n <= kPoints; ++n) {
    const double angle = 2 * std::numbers::pi * (n % kPoints) / kPoints;
    circle.push_back({10 * std::cos(angle), 10 * std::sin(angle)});
  }
  constexpr double kStep = 0.25;
  const PageLine few = thin_line(circle, kStep);
  EXPECT_LT(few.size(), 2 * std::numbers::pi * 10 / kStep + 2);
  EXPECT_EQ(few.front(), circle.front());
  EXPECT_EQ(few.back(), circle.back());
  for (const auto& p : circle) {
    double nearest = 1e9;
    for (const auto& q : few) nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1]));
    EXPECT_LE(nearest, kStep);
  }
  EXPECT_TRUE(thin_line(circle, 21).empty()) << "smaller than the step";
  EXPECT_EQ(thin_line({{0, 0}, {1, 0}, {2, 0}}, 5).size(), 2u) << "an open line keeps its ends";
}

TEST(SliceSvg, IsSmallHoweverRoughTheOutlines) {
  const Volume scan = ramp();
  const TriMesh box = cube({4, 4, 4}, 6);
  const std::vector<ShownSurface> shown{{&box, "", {1, 2, 3}, {255, 140, 26}}};
  SliceView view = slice_view(scan, shown, 2, {0, 20});
  PageLine rough;
  std::mt19937 random(1);  // the same numbers everywhere
  const auto number = [&] { return 20.0 * static_cast<double>(random()) / 4294967296.0; };
  for (int n = 0; n < 1'000'000; ++n) {
    const double x = number(), y = number();
    rough.push_back({x, y});
  }
  view.outlines[0] = {rough};
  EXPECT_LT(slice_svg(view, shown).size(), 1'200'000u);
}

TEST(SlicePicture, HasTheOutlineInItsColour) {
  const Volume scan = ramp();
  const TriMesh box = cube({4, 4, 4}, 6);
  const std::vector<ShownSurface> shown{{&box, "", {1, 2, 3}, {255, 0, 0}}};
  const Raster picture = slice_picture(slice_view(scan, shown, 2, {0, 20}), shown, 440);
  EXPECT_NEAR(picture.width, 440, 15);
  int red = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Colour c = pixel(picture, x, y);
      red += c[0] > 200 && c[1] < 60;
    }
  }
  EXPECT_NEAR(red, 4 * 6 * 20 * 1.8, 300) << "the outline is 24 mm long, 20 pixels each";
}

TEST(BarLength, IsRound) {
  EXPECT_DOUBLE_EQ(bar_length(400), 100);
  EXPECT_DOUBLE_EQ(bar_length(100), 20);
  EXPECT_DOUBLE_EQ(bar_length(2.4), 0.5);
}

}  // namespace
}  // namespace mesamis
