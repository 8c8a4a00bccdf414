// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/preview.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesamis/method/mes_amis.h"
#include "support/ball_volume.h"

namespace mesamis {
namespace {

TEST(Preview, IsAClosedBallWithoutAMesh) {
  const Volume ball = make_ball({.noise = 3, .radius = 11});
  Settings settings;
  settings.preview = true;
  const Result result = mes_amis(ball, settings);
  EXPECT_TRUE(result.mesh.cells.empty());
  EXPECT_TRUE(result.u.empty());
  EXPECT_EQ(result.iterations.size(), 1U);
  EXPECT_TRUE(result.converged);
  const SurfaceCheck check = check_surface(result.surface);
  EXPECT_EQ(solid_flaws_of(check), "");
  EXPECT_EQ(check.components, 1);
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(middle_radius(11, 1), 3);
  EXPECT_NEAR(check.volume, volume, 0.02 * volume);
}

}  // namespace
}  // namespace mesamis
