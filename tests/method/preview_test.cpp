// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/preview.h"

#include <gtest/gtest.h>

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
  const double full = check_surface(mes_amis(ball, {}).surface).volume;
  EXPECT_NEAR(check.volume, full, 0.02 * full) << "as large as the full run finds it";
}

}  // namespace
}  // namespace mesamis
