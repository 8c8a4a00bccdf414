// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace mesamis {
namespace {

std::string letters_of(const Mat3& direction) {
  const auto letters = orientation_of(direction).letters;
  return {letters.begin(), letters.end()};
}

/// Turns the identity about z.
Mat3 turned_about_z(double angle_deg) {
  const double angle = angle_deg * M_PI / 180, c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
}

TEST(Orientation, NamesTheAxesOfAlignedGrids) {
  EXPECT_EQ(letters_of({}), "LPS");
  EXPECT_EQ(letters_of({{Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}}), "RAS");
  // i runs down, j to the back, k to the left: columns of the matrix.
  EXPECT_EQ(letters_of({{Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}}}), "IPL");
  EXPECT_EQ(orientation_of({}).oblique_deg, 0);
}

TEST(Orientation, TellsHowObliqueAGridIs) {
  for (const double angle : {0.5, 12.0, 44.0}) {
    EXPECT_EQ(letters_of(turned_about_z(angle)), "LPS");
    EXPECT_NEAR(orientation_of(turned_about_z(angle)).oblique_deg, angle, 1e-6);
  }
  EXPECT_EQ(letters_of(turned_about_z(80)), "PRS");
  EXPECT_NEAR(orientation_of(turned_about_z(80)).oblique_deg, 10, 1e-6);
}

TEST(Orientation, NamesEachBodyAxisOnceHoweverTheGridIsTurned) {
  // The long diagonal for the first axis: all three body axes are equally near to it.
  const double a = 1 / std::sqrt(3), b = 1 / std::sqrt(2), c = 1 / std::sqrt(6);
  const std::string letters = letters_of({{Vec3{a, b, c}, Vec3{a, -b, c}, Vec3{a, 0, -2 * c}}});
  for (const char* pair : {"LR", "PA", "SI"}) {
    EXPECT_EQ(letters.find_first_of(pair), letters.find_last_of(pair)) << letters;
    EXPECT_NE(letters.find_first_of(pair), std::string::npos) << letters;
  }
}

TEST(Orientation, TheBodyAxisIsThatOfTheLargestCoordinate) {
  EXPECT_EQ(body_axis({-2, 0.5, 1}), 0);
  EXPECT_EQ(body_axis({0.5, -2, 1}), 1);
  EXPECT_EQ(body_axis({0.5, 1, -2}), 2);
  EXPECT_EQ(body_axis({1, -1, 1}), 0);
  EXPECT_EQ(body_axis({0, -1, 1}), 1);
}

TEST(Orientation, NamesTheSideADirectionPointsTo) {
  EXPECT_EQ(side_letter({0.6, 0.5, 0.1}), 'L');
  EXPECT_EQ(side_letter({-2, 0.5, 0.1}), 'R');
  EXPECT_EQ(side_letter({0, 1, 0.9}), 'P');
  EXPECT_EQ(side_letter({0, -1, 0.9}), 'A');
  EXPECT_EQ(side_letter({0, 0, 3}), 'S');
  EXPECT_EQ(side_letter({0, 0, -3}), 'I');
}

}  // namespace
}  // namespace mesamis
