// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/element_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesamis/base/types.h"

namespace mesamis {
namespace {

using Corners4 = std::array<Vec3, 4>;

constexpr double kDegrees = 180 / std::numbers::pi;
const Corners4 kRegular{Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 1}, Vec3{1, 0, 1}};
const Corners4 kCubeCorner{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
const Corners4 kOdd{Vec3{0.1, -0.2, 0.3}, Vec3{1.4, 0.2, 0.1}, Vec3{0.3, 0.9, -0.2},
                    Vec3{0.5, 0.1, 1.1}};

void expect_same(const ElementShape& a, const ElementShape& b) {
  EXPECT_NEAR(a.least_angle, b.least_angle, 1e-9);
  EXPECT_NEAR(a.greatest_angle, b.greatest_angle, 1e-9);
  EXPECT_NEAR(a.scaled_jacobian, b.scaled_jacobian, 1e-12);
}

Corners4 turned_inside_out(Corners4 k) {
  std::swap(k[0], k[1]);
  return k;
}

TEST(ElementQuality, ARegularTetrahedronIsPerfect) {
  const ElementShape shape = element_shape(kRegular);
  EXPECT_NEAR(shape.least_angle, kDegrees * std::acos(1.0 / 3), 1e-9);
  EXPECT_NEAR(shape.greatest_angle, kDegrees * std::acos(1.0 / 3), 1e-9);
  EXPECT_NEAR(shape.scaled_jacobian, 1, 1e-12);
}

TEST(ElementQuality, TheCornerOfACubeHasRightAngles) {
  const ElementShape shape = element_shape(kCubeCorner);
  EXPECT_NEAR(shape.least_angle, kDegrees * std::acos(1 / std::sqrt(3.0)), 1e-9);
  EXPECT_NEAR(shape.greatest_angle, 90, 1e-9);
  // 6 V = 1; at another corner the edges are 1, sqrt 2 and sqrt 2.
  EXPECT_NEAR(shape.scaled_jacobian, std::sqrt(0.5), 1e-12);
}

TEST(ElementQuality, ACellTurnedInsideOutIsNegative) {
  EXPECT_NEAR(element_shape(turned_inside_out(kRegular)).scaled_jacobian, -1, 1e-12);
  EXPECT_NEAR(element_shape(turned_inside_out(kOdd)).scaled_jacobian,
              -element_shape(kOdd).scaled_jacobian, 1e-12);
}

/// A sliver: four points near a square.
TEST(ElementQuality, AFlatCellHasNothingLeft) {
  constexpr double kHeight = 1e-6;
  const ElementShape shape =
      element_shape({Vec3{1, 0, 0}, Vec3{0, 1, kHeight}, Vec3{-1, 0, 0}, Vec3{0, -1, kHeight}});
  EXPECT_NEAR(shape.least_angle, 0, 1e-3);
  EXPECT_NEAR(shape.greatest_angle, 180, 1e-3);
  EXPECT_NEAR(shape.scaled_jacobian, 0, 1e-5);
}

TEST(ElementQuality, ShapeIsThatOfTheCellTurnedMovedAndScaled) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (const double scale : {1e-3, 1.0, 250.0}) {
    Corners4 moved;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 p = kOdd[i];
      const Vec3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
      moved[i] = scale * Vec3{q.x + 3, c * q.y - s * q.z, s * q.y + c * q.z - 2};
    }
    expect_same(element_shape(moved), element_shape(kOdd));
  }
}

TEST(ElementQuality, ShapeIsThatOfAnyOrderOfTheCorners) {
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  do {
    Corners4 k;
    for (std::size_t i = 0; i < 4; ++i) k[i] = kOdd[order[i]];
    ElementShape shape = element_shape(k);
    int inversions = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
    }
    if (inversions % 2 != 0) shape.scaled_jacobian = -shape.scaled_jacobian;
    expect_same(shape, element_shape(kOdd));
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(ElementQuality, OfAMeshIsThatOfItsWorstElements) {
  TetMesh mesh;
  // A wide one, one whose least angle is about 3 degrees, and one turned inside out.
  const Corners4 thin{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0.3, 0.3, 0.02}};
  for (const Corners4& k : {kRegular, kCubeCorner, thin, turned_inside_out(kRegular)}) {
    const auto first = static_cast<Index>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), k.begin(), k.end());
    mesh.cells.push_back({first, first + 1, first + 2, first + 3});
  }
  const ElementQuality quality = element_quality(mesh);
  EXPECT_EQ(quality.elements, 4);
  EXPECT_EQ(quality.least_angle, element_shape(thin).least_angle);
  EXPECT_EQ(quality.greatest_angle, element_shape(thin).greatest_angle);
  EXPECT_NEAR(quality.scaled_jacobian_min, -1, 1e-12);
  EXPECT_EQ(quality.share_above_15_deg, 0.75);
  EXPECT_EQ(quality.share_jacobian_above, 0.5);
}

TEST(ElementQuality, OfNoElementsIsZero) {
  const ElementQuality quality = element_quality({});
  EXPECT_EQ(quality.elements, 0);
  EXPECT_EQ(quality.scaled_jacobian_min, 0);
  EXPECT_EQ(quality.share_above_15_deg, 0);
}

}  // namespace
}  // namespace mesamis
