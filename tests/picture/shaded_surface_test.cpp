// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/shaded_surface.h"

#include <gtest/gtest.h>

#include "mesamis/surface/crease_normals.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

constexpr Colour kPaint{200, 180, 160}, kInside{10, 200, 10};

Colour pixel_of(Scene& scene, const Vec3& p) {
  const Place at = scene.on_canvas(scene.to_pixel(p));
  const std::uint8_t* bytes =
      scene.canvas().bytes.data() +
      scene.canvas().offset(static_cast<int>(at[0]), static_cast<int>(at[1]));
  return {bytes[0], bytes[1], bytes[2]};
}

ShadedSurface one_square(bool turned) {
  ShadedSurface shown;
  shown.surface = {{{0, 0, 0}, {10, 0, 0}, {10, 0, 10}, {0, 0, 10}}, {{0, 1, 2}, {0, 2, 3}}};
  if (turned) shown.surface.triangles = {{0, 2, 1}, {0, 3, 2}};
  shown.paint = [](const Fragment&) { return kPaint; };
  return shown;
}

Scene scene_of(const ShadedSurface& shown) {
  Scene scene({200, 160});
  scene.fit(camera_axes("front"), shown.surface.points, {});
  draw_shaded(scene, shown);
  return scene;
}

TEST(Shaded, FacesTheViewerFromBothSides) {
  ShadedSurface front = one_square(false), back = one_square(true);
  const Vec3 middle{5, 0, 4};
  Scene of_front = scene_of(front), of_back = scene_of(back);
  EXPECT_EQ(pixel_of(of_front, middle), lit(kPaint, {0, 0, 1}, {}));
  EXPECT_EQ(pixel_of(of_back, middle), lit(kPaint, {0, 0, 1}, {}));
  front.inside = back.inside = kInside;
  Scene outside = scene_of(front), inside = scene_of(back);
  EXPECT_EQ(pixel_of(outside, middle), lit(kPaint, {0, 0, 1}, {}));
  EXPECT_EQ(pixel_of(inside, middle), lit(kInside, {0, 0, 1}, {}));
}

TEST(Shaded, ShowsEdgesOfTriangles) {
  ShadedSurface shown = one_square(false);
  Scene without = scene_of(shown);
  shown.edges = true;
  Scene with = scene_of(shown);
  const Vec3 diagonal{5, 0, 5}, beside{7, 0, 3};
  EXPECT_LT(pixel_of(with, diagonal)[0] + 40, pixel_of(without, diagonal)[0]);
  EXPECT_EQ(pixel_of(with, beside), pixel_of(without, beside));
}

/// Along a roof the light changes at once where it is flat, and little by little where it is smooth.
TEST(Shaded, IsSmoothWithNormals) {
  ShadedSurface shown;
  shown.surface = {{{0, 0, 0}, {0, 0, 9}, {-9, 2, 0}, {-9, 2, 9}, {9, 2, 0}, {9, 2, 9}},
                   {{2, 0, 3}, {0, 1, 3}, {0, 4, 1}, {4, 5, 1}}};
  shown.paint = [](const Fragment&) { return kPaint; };
  const auto jump = [&] {
    Scene scene = scene_of(shown);
    return std::abs(pixel_of(scene, {-0.3, 0, 4})[0] - pixel_of(scene, {0.3, 0, 4})[0]);
  };
  const int flat = jump();
  shown.normals = crease_normals(shown.surface, 40);
  EXPECT_LT(3 * jump(), flat);
}

}  // namespace
}  // namespace mesamis
