// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/level.h"

#include <gtest/gtest.h>

#include "mesamis/method/prepare.h"
#include "support/ball_volume.h"

namespace mesamis {
namespace {

/// A mesh of the voxel grid that carries the image itself as u.
struct OnGrid {
  explicit OnGrid(const Volume& volume) {
    const auto& n = volume.size;
    mesh = box_mesh(volume.box(), {n[0] - 1, n[1] - 1, n[2] - 1});
    for (const Vec3& p : mesh.points) {
      u.push_back(volume.at(static_cast<Index>(std::lround(p.x)),
                            static_cast<Index>(std::lround(p.y)),
                            static_cast<Index>(std::lround(p.z))));
    }
  }
  TetMesh mesh;
  std::vector<double> u;
};

Parameters grey_as_it_is(double first_level) {
  Parameters p;
  p.grey = {0, 255, 0};
  p.level = first_level;
  return p;
}

TEST(ChooseLevel, TheUsersLevelStands) {
  const Volume volume = make_ball({.size = 24, .radius = 7});
  Settings settings;
  settings.level = 140;
  const OnGrid grid(volume);
  EXPECT_EQ(choose_level(volume, settings, grey_as_it_is(140), {grid.mesh, grid.u}), 140);
}

TEST(ChooseLevel, FindsTheHalfMaximumFromAnEstimateOnEitherSide) {
  const Volume volume = make_ball({.size = 32, .noise = 3, .radius = 10});
  const OnGrid grid(volume);
  for (const double first : {165.0, 185.0}) {
    EXPECT_NEAR(choose_level(volume, {}, grey_as_it_is(first), {grid.mesh, grid.u}), 175, 4);
  }
}

TEST(ChooseLevel, ALevelBelowTIsNotTaken) {
  const Volume volume = make_ball({.size = 32, .noise = 3, .radius = 10});
  const OnGrid grid(volume);
  Parameters p = grey_as_it_is(215);
  p.grey.threshold = 210;
  EXPECT_EQ(choose_level(volume, {}, p, {grid.mesh, grid.u}), 215);
}

TEST(ChooseLevel, AnEmptyLevelSetKeepsTheFirstEstimate) {
  const Volume volume = make_ball({.size = 24, .radius = 7});
  const OnGrid grid(volume);
  EXPECT_EQ(choose_level(volume, {}, grey_as_it_is(254), {grid.mesh, grid.u}), 254);
}

}  // namespace
}  // namespace mesamis
