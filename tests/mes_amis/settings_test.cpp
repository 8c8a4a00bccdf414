// SPDX-License-Identifier: Apache-2.0
#include "mesamis/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesamis/base/error.h"

namespace mesamis {
namespace {

std::string refusal(const Settings& settings) {
  try {
    require_valid(settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Settings, DefaultsAreValid) { EXPECT_EQ(refusal({}), ""); }

TEST(Settings, ARefusedValueNamesItsRange) {
  Settings settings;
  settings.beta = -1;
  EXPECT_EQ(refusal(settings), "beta: expected 1e-12 to 1e+12, found -1");
  settings = {};
  settings.adaptations = -1;
  EXPECT_THAT(refusal(settings), ::testing::HasSubstr("adaptations"));
  settings = {};
  settings.gradation = 1;
  EXPECT_EQ(refusal(settings), "gradation (other than 0): expected 1.01 to 1000, found 1");
  settings.gradation = 1.5;
  EXPECT_EQ(refusal(settings), "");
  settings = {};
  settings.tolerance = -0.1;
  EXPECT_THAT(refusal(settings), ::testing::HasSubstr("tolerance"));
  settings = {};
  settings.triangles = 3;
  EXPECT_THAT(refusal(settings), ::testing::HasSubstr("triangles"));
  settings = {};
  settings.window = Window{3, 3};
  EXPECT_EQ(refusal(settings), "window: expected low below high, found 3,3");
}

TEST(Settings, NothingThatIsNotANumberPasses) {
  for (double Settings::*member :
       {&Settings::epsilon, &Settings::beta, &Settings::tol_v, &Settings::solver_tolerance,
        &Settings::tau, &Settings::tol_mesh, &Settings::tol_energy, &Settings::h_min,
        &Settings::band_threshold}) {
    Settings settings;
    settings.*member = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refusal(settings), "");
    settings.*member = std::numeric_limits<double>::infinity();
    EXPECT_NE(refusal(settings), "");
  }
}

TEST(Settings, WhatIsKnownOfTheImageIsChecked) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {-1.0, nan}) {
    Settings settings;
    settings.noise = value;
    EXPECT_THAT(refusal(settings), ::testing::HasSubstr("noise: expected 0"));
    settings = {};
    settings.blur = {1, value, 1};
    EXPECT_THAT(refusal(settings), ::testing::HasSubstr("blur: expected 0 to 3"));
    settings = {};
    settings.gamma = value;
    EXPECT_THAT(refusal(settings), ::testing::HasSubstr("gamma: expected"));
  }
}

TEST(DefaultGamma, IsAPriceOfGreyValuesSquared) {
  const double one = default_gamma(1e-3, 2, 100, 5);
  EXPECT_NEAR(default_gamma(1e-3, 2, 300, 15), 9 * one, 1e-12);
  EXPECT_NEAR(default_gamma(1e-3, 4, 100, 5), 2 * one, 1e-12);
  EXPECT_GT(default_gamma(1e-3, 2, 100, 10), one);
}

TEST(DefaultMaxTets, GrowsWithTheEdgesWithinBounds) {
  EXPECT_EQ(default_max_tets(0, {1, 1, 1}), 20'000);
  EXPECT_EQ(default_max_tets(50'000, {1, 1, 1}), 225'000);
  EXPECT_EQ(default_max_tets(1e9, {1, 1, 1}), 2'000'000);
  // The same surface in voxels half as wide, and in slices four times as thick.
  EXPECT_EQ(default_max_tets(12'500, {0.5, 0.5, 0.5}), 225'000);
  EXPECT_EQ(default_max_tets(50'000, {1, 1, 4}), 225'000);
  EXPECT_EQ(default_max_tets(50'000, {0.1, 0.1, 8}), 225'000);
}

}  // namespace
}  // namespace mesamis
