// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/phantom_truth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mesamis {
namespace {

constexpr std::array<Index, 3> kSize{16, 16, 16};

TEST(PhantomTruth, KeepsItsBound) {
  for (const char* name : {"sphere", "plate", "femur", "fracture"}) {
    const PhantomTruth truth = make_truth(make_phantom(name, kSize));
    EXPECT_TRUE(truth.is_closed_manifold()) << name;
    EXPECT_TRUE(truth.within_bound()) << name << ": " << truth.error.max;
    EXPECT_LE(truth.error.mean, truth.error.max) << name;
    EXPECT_GT(truth.check.volume, 0) << name << " faces inward";
  }
}

TEST(PhantomTruth, ItsPointsLieOnTheZero) {
  const Phantom phantom = make_phantom("sphere", kSize);
  for (const Vec3& p : make_truth(phantom).surface.points) {
    ASSERT_NEAR(phantom.inside(p), 0, 1e-3);
  }
}

TEST(PhantomTruth, TheBoundIsThatOfTheShortestSide) {
  const PhantomTruth truth = make_truth(make_phantom("sphere", kSize, {0.5, 1, 2}));
  EXPECT_DOUBLE_EQ(truth.error_bound, 0.5 * kTruthErrorVoxel);
  EXPECT_TRUE(truth.within_bound());
}

TEST(PhantomTruth, TellsWhatIsNotKept) {
  PhantomTruth truth = make_truth(make_phantom("sphere", kSize));
  truth.error.max = 1.01 * truth.error_bound;
  EXPECT_FALSE(truth.within_bound());
  truth.surface.triangles.pop_back();
  truth.check = check_surface(truth.surface);
  EXPECT_FALSE(truth.is_closed_manifold());
}

}  // namespace
}  // namespace mesamis
