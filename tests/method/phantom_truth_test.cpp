// SPDX-License-Identifier: Apache-2.0
// The truth of every phantom, judged without the code that made it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "mesamis/phantom/implicit_surface.h"
#include "mesamis/phantom/phantom.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis {
namespace {

struct Case {
  const char* name;
  std::array<Index, 3> size;
  std::int64_t euler;  ///< points - edges + triangles
};

void PrintTo(const Case& of, std::ostream* out) { *out << of.name; }

class PhantomTruth : public testing::TestWithParam<Case> {};

/// The distance from p to the zero along the gradient, by bisection.
double distance_to_zero(const Phantom& phantom, const Vec3& p) {
  Vec3 slope;
  for (int a = 0; a < 3; ++a) {
    Vec3 step;
    step[a] = 1e-6;
    slope[a] = phantom.inside(p + step) - phantom.inside(p - step);
  }
  const bool is_inside = phantom.inside(p) > 0;
  const Vec3 way = (is_inside ? -1 : 1) / norm(slope) * slope;
  double lo = 0, hi = 0.1;
  if ((phantom.inside(p + hi * way) > 0) == is_inside) return hi;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (lo + hi);
    ((phantom.inside(p + middle * way) > 0) == is_inside ? lo : hi) = middle;
  }
  return hi;
}

TEST_P(PhantomTruth, IsAClosedManifoldNearTheZero) {
  const Phantom phantom = make_phantom(GetParam().name, GetParam().size);
  const TriMesh truth = extract_implicit(phantom.lines, phantom.inside, 0.012);
  const SurfaceCheck check = check_surface(truth);
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_EQ(check.components, 1);
  const auto triangles = static_cast<std::int64_t>(truth.triangles.size());
  EXPECT_EQ(static_cast<std::int64_t>(truth.points.size()) - triangles / 2, GetParam().euler);
  EXPECT_THAT(find_self_intersections(truth), testing::IsEmpty());
  double worst = 0;
  for (std::size_t t = 0; t < truth.triangles.size(); t += 7) {
    const Triangle& k = truth.triangles[t];
    const Vec3 &a = truth.points[k[0]], &b = truth.points[k[1]], &c = truth.points[k[2]];
    for (const Vec3& p : {a, 0.5 * (a + b), 1.0 / 3 * (a + b + c), 0.6 * a + 0.2 * (b + c)}) {
      worst = std::max(worst, distance_to_zero(phantom, p));
    }
  }
  EXPECT_LT(worst, 0.02);
}

/// The other direction: no part of the object is missing. Voxels see all of it.
TEST_P(PhantomTruth, HasTheVolumeOfTheVoxels) {
  Phantom phantom = make_phantom(GetParam().name, GetParam().size);
  phantom.grey = [](const Vec3&, double) { return 121.0; };
  phantom.constant_below = 0;
  const TriMesh truth = extract_implicit(phantom.lines, phantom.inside, 0.012);
  double volume = 0;
  for (const float x : sample_phantom(phantom, 8).samples) volume += x - 120.0;
  EXPECT_NEAR(check_surface(truth).volume / volume, 1, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(All, PhantomTruth,
                         testing::Values(Case{"sphere", {64, 64, 64}, 2},
                                         Case{"plate", {64, 64, 64}, 2},
                                         Case{"femur", {64, 64, 96}, 2},
                                         Case{"fracture", {64, 64, 64}, 2},
                                         Case{"hemipelvis", {51, 61, 76}, 0}),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(PhantomTruthSphere, HasKnownVolumeAndArea) {
  const Phantom phantom = make_phantom("sphere", {32, 32, 32}, {2, 2, 2});
  const SurfaceCheck check = check_surface(extract_implicit(phantom.lines, phantom.inside, 0.012));
  constexpr double kPi = 3.14159265358979323846;
  EXPECT_NEAR(check.volume / (4.0 / 3 * kPi * 8000), 1, 3 * 0.012 / 20);
  EXPECT_NEAR(check.area / (4 * kPi * 400), 1, 2e-3);
}

}  // namespace
}  // namespace mesamis
