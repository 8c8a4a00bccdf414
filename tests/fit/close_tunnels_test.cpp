// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/close_tunnels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/extract_cubes.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

constexpr Index kWidth = 40;
const Vec3 kMiddle{20, 20, 20};

/// A field of which each place is known: 1 within the object, -1 around it.
Volume field(const std::function<double(const Vec3&)>& height) {
  return sampled_volume({kWidth, kWidth, kWidth}, {1, 1, 1}, height);
}

/// A hollow ball with a wall of two voxels and a hole of three voxels in radius, which is filled to
/// the given height.
Volume shell_with_hole(double filled) {
  return field([filled](const Vec3& p) {
    const Vec3 way = p - kMiddle;
    const double shell = std::clamp(2 - 2 * std::abs(norm(way) - 14), -1.0, 1.0);
    return way.z > 0 && std::hypot(way.x, way.y) < 3 ? std::min(shell, filled) : shell;
  });
}

/// A block of 8 voxels in height, with a slot through it that is filled to -0.3.
/// @param half  of the slot's two sides, voxels.
Volume block_with_slot(const std::array<double, 2>& half) {
  return field([&half](const Vec3& p) {
    const Vec3 way = p - kMiddle;
    if (std::abs(way.z) > 4 || std::max(std::abs(way.x), std::abs(way.y)) > 17) return -1.0;
    return std::abs(way.x) < half[0] && std::abs(way.y) < half[1] ? -0.3 : 1.0;
  });
}

/// The skins of what lies above 0.
Index skins_of(const Volume& height) {
  return static_cast<Index>(
      check_surface(extract_cubes({height.size, height.spacing, height.samples}, 0)).components);
}

void add(const TunnelLift& found, Volume& height) {
  for (std::size_t n = 0; n < height.samples.size(); ++n) {
    height.samples[n] += found.lift.samples[n];
  }
}

TEST(TunnelLift, ClosesAFaintHoleInAThinWall) {
  Volume height = shell_with_hole(-0.3);
  EXPECT_EQ(skins_of(height), 1) << "from outside through the hole";
  const TunnelLift found = find_tunnel_lift(height);
  EXPECT_EQ(found.sheets, 1);
  EXPECT_GT(found.voxels, 9);
  const std::vector<float> before = height.samples;
  add(found, height);
  EXPECT_EQ(skins_of(height), 2) << "an outer and an inner one";
  for (std::size_t n = 0; n < before.size(); ++n) {
    ASSERT_GE(height.samples[n], before[n]);
    ASSERT_TRUE(before[n] > -1 || height.samples[n] < 0) << "the wall gets no thicker than it is";
  }
  EXPECT_EQ(find_tunnel_lift(height).sheets, 0) << "nothing is left to close";
}

TEST(TunnelLift, LeavesADarkHoleOpen) {
  EXPECT_EQ(find_tunnel_lift(shell_with_hole(-0.8)).sheets, 0);
}

TEST(TunnelLift, LeavesWholeObjectsAlone) {
  EXPECT_EQ(find_tunnel_lift(shell_with_hole(1)).sheets, 0);
  EXPECT_EQ(find_tunnel_lift(field([](const Vec3&) { return -1; })).sheets, 0);
  EXPECT_EQ(find_tunnel_lift(field([](const Vec3&) { return -0.3; })).sheets, 0);
}

/// Two bones and the faint space between them, as of a joint.
TEST(TunnelLift, JoinsNoPartsThatAreApart) {
  const Volume height = field([](const Vec3& p) {
    const double high = std::abs(p.z - 20);
    if (std::abs(p.x - 20) > 15 || std::abs(p.y - 20) > 15 || high > 2.5) return -1.0;
    if (high < 0.5) return -0.3;
    return 1.0;
  });
  EXPECT_EQ(skins_of(height), 2);
  EXPECT_EQ(find_tunnel_lift(height).sheets, 0);
}

/// A fracture is long and narrow.
TEST(TunnelLift, LeavesNarrowSlitsOpen) {
  EXPECT_EQ(find_tunnel_lift(block_with_slot({1, 12})).sheets, 0);
}

TEST(TunnelLift, HasTheSameBitsForAnyNumberOfThreads) {
  const auto run = [] { return find_tunnel_lift(shell_with_hole(-0.3)).lift.samples; };
  EXPECT_EQ(with_threads(1, run), with_threads(3, run));
}

}  // namespace
}  // namespace mesamis
