// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/scene.h"

#include <gmock/gmock.h>

#include <cmath>

#include "support/png_image.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(CameraAxes, AreARightHandedFrameOfUnitVectors) {
  for (const char* view : {"front", "back", "left", "right", "top", "bottom", "oblique"}) {
    const CameraAxes axes = camera_axes(view);
    EXPECT_NEAR(norm(axes.forward), 1, 1e-12) << view;
    EXPECT_NEAR(norm(axes.up), 1, 1e-12) << view;
    EXPECT_NEAR(norm(axes.right()), 1, 1e-12) << view;
    EXPECT_NEAR(dot(axes.forward, axes.up), 0, 1e-12) << view;
  }
  EXPECT_EQ(camera_axes("front").right(), (Vec3{1, 0, 0})) << "the patient's left is on the right";
  EXPECT_EQ(camera_axes("left").right(), (Vec3{0, 1, 0})) << "the patient's back is on the right";
  EXPECT_REFUSED(camera_axes("up"), HasSubstr("no view 'up', expected front, back"));
}

TEST(Scene, FitPutsAllPointsInsideTheMargins) {
  const std::vector<Vec3> points{{1, 2, 3}, {11, 2, 3}, {1, 27, 3}, {1, 2, 8}};
  const Margins margins{0.1, 0.2, 0.15, 0.05};
  for (const char* view : {"front", "oblique", "top"}) {
    Scene scene({300, 200});
    scene.fit(camera_axes(view), points, margins);
    const auto [width, height] = scene.size();
    std::array<double, 2> lo{1e9, 1e9}, hi{-1e9, -1e9};
    for (const Vec3& p : points) {
      const auto pixel = scene.to_pixel(p);
      for (std::size_t i = 0; i < 2; ++i) {
        lo[i] = std::min(lo[i], pixel[i]);
        hi[i] = std::max(hi[i], pixel[i]);
      }
    }
    EXPECT_NEAR((lo[0] + hi[0]) / 2, width * (0.1 + 0.8) / 2, 1e-6)
        << "centred between the margins";
    EXPECT_NEAR((lo[1] + hi[1]) / 2, height * (0.15 + 0.95) / 2, 1e-6);
    const double share_x = (hi[0] - lo[0]) / (0.7 * width);
    const double share_y = (hi[1] - lo[1]) / (0.8 * height);
    EXPECT_NEAR(std::max(share_x, share_y), 1, 1e-9) << "as large as possible";
  }
}

TEST(Scene, ZoomMagnifiesAroundTheFocus) {
  Scene scene({300, 200});
  scene.fit(camera_axes("front"), std::vector<Vec3>{{0, 0, 0}, {10, 0, 10}}, {});
  const double before = scene.mm_per_pixel();
  const Vec3 focus{2, 0, 9};
  scene.zoom_in(4, focus);
  EXPECT_NEAR(scene.mm_per_pixel(), before / 4, 1e-12);
  const auto pixel = scene.to_pixel(focus);
  EXPECT_NEAR(pixel[0], scene.size()[0] / 2.0, 1e-9);
  EXPECT_NEAR(pixel[1], scene.size()[1] / 2.0, 1e-9);
  EXPECT_NEAR(scene.to_pixel(focus + Vec3{1, 0, 0})[0] - pixel[0], 1 / scene.mm_per_pixel(), 1e-9);
  for (const double zoom : {0.0, -1.0, std::nan("")}) {
    EXPECT_REFUSED(scene.zoom_in(zoom, {}), HasSubstr("zoom"));
  }
}

TEST(Scene, SavesTheSizeThatWasOrdered) {
  const TempFolder folder;
  for (const std::array<int, 2> size : {std::array{64, 100}, {321, 77}}) {
    Scene scene(size);
    scene.save(folder / "a.png");
    const Image image(folder / "a.png");
    EXPECT_EQ(image.size(), size);
    EXPECT_TRUE(image.at(10, 10).is_white()) << "an empty scene";
  }
  EXPECT_EQ(folder.file_count(), 1);
  Scene scene({64, 64});
  EXPECT_THROW(scene.save(folder / "none/a.png"), InputError);
}

TEST(Scene, RefusesASizeOutOfRange) {
  for (const std::array<int, 2> size : {std::array{63, 100}, {100, 8193}, {-1, 100}}) {
    EXPECT_REFUSED(Scene{size}, HasSubstr("expected 64 to 8192 pixels"));
  }
}

}  // namespace
}  // namespace mesamis
