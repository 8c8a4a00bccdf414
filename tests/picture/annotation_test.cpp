// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/annotation.h"

#include <gmock/gmock.h>

#include "support/png_image.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

/// Where a picture is not white, in pixels from the lower left corner.
struct Ink {
  int count = 0;
  std::array<int, 2> lo{1 << 30, 1 << 30}, hi{-1, -1};

  explicit Ink(const Image& image) {
    for (int y = 0; y < image.size()[1]; ++y) {
      for (int x = 0; x < image.size()[0]; ++x) {
        if (image.at(x, y).is_white()) continue;
        ++count;
        lo = {std::min(lo[0], x), std::min(lo[1], y)};
        hi = {std::max(hi[0], x), std::max(hi[1], y)};
      }
    }
  }
};

class AnnotationTest : public testing::Test {
 protected:
  /// What a scene of 500 x 400 pixels looks like after add(scene); 10 mm wide inside the margins.
  template <class Add>
  Image drawn(const Add& add) {
    Scene scene({500, 400});
    scene.fit(camera_axes("front"), std::vector<Vec3>{{0, 0, 0}, {10, 0, 1}}, {});
    mm_per_pixel_ = scene.mm_per_pixel();
    add(scene);
    scene.save(folder_ / "a.png");
    return Image(folder_ / "a.png");
  }
  double mm_per_pixel_ = 0;  // of the file

 private:
  TempFolder folder_;
};

TEST(ShortNumber, HasFourDigitsAndNoNeedlessZeros) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(-1e-15), "0");
  EXPECT_EQ(short_number(2.5), "2.5");
  EXPECT_EQ(short_number(123.456), "123.5");
  EXPECT_EQ(short_number(-20), "-20");
}

TEST_F(AnnotationTest, LabelsAreAlignedToTheirPlace) {
  const auto ink = [this](Align align) {
    return Ink(drawn([align](Scene& scene) {
      const auto [width, height] = scene.size();
      add_label(scene, {"12345678", {width / 2.0, height / 2.0}, align});
    }));
  };
  const Ink left = ink(Align::kLeft), center = ink(Align::kCenter), right = ink(Align::kRight);
  EXPECT_NEAR(left.lo[0], 250, 3);
  EXPECT_NEAR((center.lo[0] + center.hi[0]) / 2.0, 250, 3);
  EXPECT_NEAR(right.hi[0], 250, 3);
  EXPECT_NEAR((center.lo[1] + center.hi[1]) / 2.0, 200, 3);
}

TEST_F(AnnotationTest, LabelsGrowWithTheirHeight) {
  const auto width = [this](double height) {
    const Ink ink(drawn([height](Scene& scene) {
      add_label(scene, {"MMMM", {20, 100}, Align::kLeft, height});
    }));
    return ink.hi[0] - ink.lo[0];
  };
  EXPECT_NEAR(width(60), 3 * width(20), 8);
}

TEST_F(AnnotationTest, ScaleBarHasARoundLengthInTheLowerRightCorner) {
  const Image image = drawn([](Scene& scene) { add_scale_bar(scene); });
  const Ink ink(image);
  EXPECT_GT(ink.lo[0], 250);
  EXPECT_LT(ink.hi[1], 100);
  // The bar is the widest part, 2 mm of the 10 that fill nine tenths of the width.
  EXPECT_NEAR((ink.hi[0] - ink.lo[0]) * mm_per_pixel_, 2, 0.1);
}

TEST_F(AnnotationTest, ColorBarRunsFromItsLowestColourToItsHighest) {
  const Image image = drawn([](Scene& scene) { add_color_bar(scene, {"u", {0, 1}, viridis}); });
  const Ink ink(image);
  EXPECT_GT(ink.lo[0], 500 * (1 - kColorBarMargin)) << "in its margin";
  const int x = 500 - 94 / 2;  // the middle of the strip
  for (const double share : {0.05, 0.5, 0.95}) {
    const int y = static_cast<int>(400 * (0.22 + 0.62 * share));
    const auto expected = viridis(share);
    const mesamis::Rgb found = image.at(x, y);
    EXPECT_NEAR(found.r, expected[0], 6) << share;
    EXPECT_NEAR(found.g, expected[1], 6) << share;
    EXPECT_NEAR(found.b, expected[2], 6) << share;
  }
}

}  // namespace
}  // namespace mesamis
