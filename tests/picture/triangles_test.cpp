// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/triangles.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <random>

#include "mesamis/base/threads.h"
#include "page/unpacked.h"

namespace mesamis {
namespace {

constexpr Colour kPaper{255, 255, 255}, kRed{255, 0, 0}, kBlue{0, 0, 255};
const Shader kBlack = [](const Fragment&) { return Colour{}; };

/// Black in whole pixels, of black on white.
double blackness(const Raster& picture) {
  double sum = 0;
  for (std::size_t n = 0; n < picture.bytes.size(); n += 3) sum += (255 - picture.bytes[n]) / 255.0;
  return sum;
}

Raster drawn(const PageTriangles& shown, const Shader& shader = kBlack) {
  Raster picture = blank(64, 48, kPaper);
  draw_triangles(picture, shown, shader);
  return picture;
}

TEST(Triangles, CoverTheirArea) {
  const PageTriangles shown{{{5.3, 4.1, 0}, {50.7, 9.9, 0}, {20.2, 40.5, 0}}, {{0, 1, 2}}};
  const double area = std::abs((50.7 - 5.3) * (40.5 - 4.1) - (20.2 - 5.3) * (9.9 - 4.1)) / 2;
  EXPECT_NEAR(blackness(drawn(shown)), area, 0.005 * area);
  const PageTriangles turned{shown.points, {{0, 2, 1}}};
  EXPECT_EQ(drawn(turned).bytes, drawn(shown).bytes) << "from behind";
}

/// A fan that fills a rectangle covers each pixel of it once: no gap, however the sides run.
TEST(Triangles, ThatShareASideLeaveNoGap) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> x(2, 62), y(2, 46);
  for (int run = 0; run < 50; ++run) {
    const PageTriangles shown{
        {{0, 0, 0}, {64, 0, 0}, {64, 48, 0}, {0, 48, 0}, {x(generator), y(generator), 0}},
        {{0, 1, 4}, {4, 1, 2}, {2, 3, 4}, {3, 0, 4}}};
    const Raster picture = drawn(shown);
    EXPECT_EQ(picture.bytes, blank(64, 48, {}).bytes);
  }
}

TEST(Triangles, NearestToTheViewerAreSeenInWhateverOrder) {
  const std::vector<Vec3> points{{0, 0, 1}, {64, 0, 1}, {0, 48, 1},
                                 {0, 0, 2}, {64, 0, 2}, {0, 48, 0}};
  for (const bool swapped : {false, true}) {
    PageTriangles shown{points, {{0, 1, 2}, {3, 4, 5}}};
    if (swapped) std::swap(shown.triangles[0], shown.triangles[1]);
    const std::size_t sloping = swapped ? 0 : 1;
    const Raster picture =
        drawn(shown, [&](const Fragment& f) { return f.triangle == sloping ? kRed : kBlue; });
    EXPECT_EQ(pixel(picture, 5, 5), kRed) << "above the half of its slope it is in front";
    EXPECT_EQ(pixel(picture, 5, 40), kBlue);
  }
}

TEST(Triangles, ThatAreEquallyNearShowTheFirst) {
  const PageTriangles shown{{{0, 0, 1}, {64, 0, 1}, {0, 48, 1}}, {{0, 1, 2}, {0, 1, 2}}};
  const Raster picture =
      drawn(shown, [](const Fragment& f) { return f.triangle == 0 ? kRed : kBlue; });
  EXPECT_EQ(pixel(picture, 5, 5), kRed);
}

TEST(Triangles, TellWhereAFragmentLies) {
  const PageTriangles shown{{{2, 3, 0}, {60, 5, 0}, {12, 44, 0}}, {{0, 1, 2}}};
  std::atomic<int> count = 0;
  std::atomic<bool> right = true;
  drawn(shown, [&](const Fragment& f) {
    const double sum = f.weights[0] + f.weights[1] + f.weights[2];
    // Of the height over the side opposite to a corner, its weight is the share.
    const double area = (58.0 * 41 - 10.0 * 2) / 2;
    const double to_first = f.weights[0] * 2 * area / std::hypot(48, 39);
    right = right && std::abs(sum - 1) < 1e-9 && f.side_distance <= to_first + 1e-9 &&
            f.side_distance >= 0;
    ++count;
    return Colour{};
  });
  EXPECT_TRUE(right);
  EXPECT_GT(count, 9000);
}

TEST(Triangles, OutsideOrNotFiniteAreLeftOut) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const PageTriangles shown{{{-50, -50, 0},
                             {-40, -50, 0},
                             {-50, -40, 0},
                             {1e300, 5, 0},
                             {nan, 3, 0},
                             {infinity, 4, 0},
                             {3, 1e9, 0},
                             {9, 9, 0}},
                            {{0, 1, 2}, {3, 4, 5}, {5, 0, 7}, {7, 7, 7}, {4, 7, 0}, {0, 7, 7}}};
  EXPECT_EQ(drawn(shown).bytes, blank(64, 48, kPaper).bytes);
  // A triangle of which only the middle is in the picture fills it.
  const PageTriangles large{{{-1e6, -1e6, 0}, {1e6, -1e6, 0}, {0, 1e7, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(drawn(large).bytes, blank(64, 48, {}).bytes);
}

TEST(Triangles, GiveTheSameBytesForAnyNumberOfThreads) {
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> at(-5, 70);
  PageTriangles shown;
  for (Index n = 0; n < 300; ++n) {
    shown.points.push_back({at(generator), at(generator), at(generator)});
    if (n > 1) shown.triangles.push_back({n - 2, n - 1, n});
  }
  const Shader shader = [](const Fragment& f) {
    return Colour{static_cast<std::uint8_t>(f.triangle % 256), 9,
                  static_cast<std::uint8_t>(255 * f.weights[1])};
  };
  const auto bytes = [&] { return drawn(shown, shader).bytes; };
  EXPECT_EQ(with_threads(1, bytes), with_threads(2, bytes));
}

}  // namespace
}  // namespace mesamis
