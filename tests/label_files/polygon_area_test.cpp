// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/polygon_area.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::FloatNear;
using Polygon = std::vector<PlanePoint>;

constexpr PixelWindow kAll{0, 0, 8, 6};

double area_in(const Polygon& polygon, const PixelWindow& window) {
  const auto shares = pixel_shares(polygon, window);
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

Polygon reversed(Polygon polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

TEST(PolygonArea, SharesOfARectangleAreItsOverlaps) {
  const Polygon box{{0.75, -0.25}, {2, -0.25}, {2, 1}, {0.75, 1}};
  for (const Polygon& polygon : {box, reversed(box)}) {
    EXPECT_THAT(pixel_shares(polygon, {0, 0, 4, 3}),
                ElementsAre(0, 0.5625f, 0.375f, 0, 0, 0.375f, 0.25f, 0, 0, 0, 0, 0));
  }
}

/// What a walk over many points of each pixel finds.
float sampled_share(const Polygon& polygon, Index column, Index row) {
  constexpr int kSamples = 64;
  int inside = 0;
  for (int n = 0; n < kSamples * kSamples; ++n) {
    const PlanePoint p{column - 0.5 + (n % kSamples + 0.5) / kSamples,
                       row - 0.5 + (n / kSamples + 0.5) / kSamples};
    int winding = 0;
    for (std::size_t e = 0; e < polygon.size(); ++e) {
      const PlanePoint a = polygon[e], b = polygon[(e + 1) % polygon.size()];
      const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (a.y <= p.y && b.y > p.y && side > 0) ++winding;
      if (a.y > p.y && b.y <= p.y && side < 0) --winding;
    }
    inside += winding != 0 ? 1 : 0;
  }
  return static_cast<float>(inside) / (kSamples * kSamples);
}

TEST(PolygonArea, AgreesWithBruteForceAlsoBeyondTheWindow) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(0.5, 5), turn(0, 0.5);
  for (int round = 0; round < 8; ++round) {
    Polygon star;
    for (double a = turn(random); a < 2 * std::numbers::pi; a += 0.3 + turn(random)) {
      const double r = radius(random);
      star.push_back({4 + r * std::cos(a), 2.5 + r * std::sin(a)});
    }
    const auto shares = pixel_shares(star, kAll);
    for (Index row = 0; row < kAll.rows; ++row) {
      for (Index column = 0; column < kAll.columns; ++column) {
        EXPECT_THAT(shares[static_cast<std::size_t>(row * kAll.columns + column)],
                    FloatNear(sampled_share(star, column, row), 0.02f));
      }
    }
  }
}

TEST(PolygonArea, AHoleThatTheContourGoesAroundBackwardsIsOpen) {
  const Polygon keyhole{{0, 0}, {6, 0}, {6, 5}, {0, 5}, {0, 0},
                        {1, 1}, {1, 3}, {4, 3}, {4, 1}, {1, 1}};
  EXPECT_NEAR(area_in(keyhole, kAll), 30 - 6, 1e-6);
  EXPECT_FLOAT_EQ(pixel_shares(keyhole, kAll)[2 * 8 + 2], 0);
}

TEST(PolygonArea, OfPixelsThatItOverlapsTwiceIsOne) {
  const Polygon twice{{0, 0}, {5, 0}, {5, 5}, {0, 5}, {0, 0}, {5, 0}, {5, 5}, {0, 5}};
  EXPECT_FLOAT_EQ(pixel_shares(twice, kAll)[8 + 1], 1);
}

TEST(PolygonArea, WindowHoldsWhatThePolygonTouches) {
  const Polygon box{{1.2, 2.6}, {3.4, 2.6}, {3.4, 3.7}};
  const PixelWindow window = window_of(box, {0, 0, 10, 10});
  EXPECT_EQ(window.left, 1);
  EXPECT_EQ(window.top, 3);
  EXPECT_NEAR(area_in(box, window), 0.5 * 2.2 * 1.1, 1e-6);
  EXPECT_EQ(window_of({{{-9, -9}, {-8, -9}, {-8, -8}}}, {0, 0, 10, 10}).pixels(), 0u);
  EXPECT_EQ(window_of({{{50, 50}, {51, 50}, {51, 51}}}, {0, 0, 10, 10}).pixels(), 0u);
  EXPECT_EQ(window_of({{{-50, -50}, {50, -50}, {50, 50}}}, {0, 0, 10, 10}).pixels(), 100u);
}

}  // namespace
}  // namespace mesamis
