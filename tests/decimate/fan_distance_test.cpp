// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/fan_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "mesamis/surface/distance.h"
#include "mesamis/surface/sampling.h"

namespace mesamis {
namespace {

/// A ring of points around the z axis, its heights at random.
std::vector<Vec3> rough_ring(std::size_t n, unsigned seed, double roughness) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> around(-1, 1);
  std::vector<Vec3> ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    const double radius = 1 + 0.1 * around(generator);
    ring.push_back(
        {radius * std::cos(angle), radius * std::sin(angle), roughness * around(generator)});
  }
  return ring;
}

/// The fan of the points in order, its first point the apex.
TriMesh fan(const Vec3& apex, const std::vector<Vec3>& rim, bool closed) {
  TriMesh surface{{apex}, {}};
  surface.points.insert(surface.points.end(), rim.begin(), rim.end());
  const auto n = static_cast<Index>(rim.size());
  for (Index i = 1; i < n; ++i) surface.triangles.push_back({0, i, i + 1});
  if (closed) surface.triangles.push_back({0, n, 1});
  return surface;
}

TriMesh fan_after(const std::vector<Vec3>& ring) {
  return fan(ring[0], {ring.begin() + 1, ring.end()}, false);
}

double farthest_sample(const TriMesh& from, const TriMesh& to) {
  const auto distances = distances_to_surface(sample_by_area(from, 5000), to);
  return *std::max_element(distances.begin(), distances.end());
}

TEST(FanDistance, BoundsTheDistancesInBothDirections) {
  int flat = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const auto ring = rough_ring(3 + seed % 6, seed, 0.2);
    const Vec3 apex{0.1, -0.05, 0.15};
    const double bound = fan_distance(apex, ring);
    if (std::isinf(bound)) continue;
    ++flat;
    const TriMesh before = fan(apex, ring, true), after = fan_after(ring);
    EXPECT_LE(farthest_sample(before, after), bound * (1 + 1e-9)) << seed;
    EXPECT_LE(farthest_sample(after, before), bound * (1 + 1e-9)) << seed;
  }
  EXPECT_GT(flat, 50);
}

TEST(FanDistance, OfARidgeIsItsHeightAboveTheEdgeThatReplacesIt) {
  // A square with its apex lifted: both new triangles meet in the diagonal, h below the apex.
  const std::vector<Vec3> square{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  EXPECT_NEAR(fan_distance({0, 0, 0.25}, square), 0.25, 1e-12);
  // A saddle whose apex lies on the new diagonal: the fans part nowhere.
  const std::vector<Vec3> saddle{{1, 0, 0.3}, {0, 1, -0.3}, {-1, 0, 0.3}, {0, -1, -0.3}};
  EXPECT_NEAR(fan_distance({0, 0, 0.3}, saddle), 0, 1e-12);
}

TEST(FanDistance, SeesWhereEdgesCross) {
  // The apex lies in the plane of the new triangles; the old edge to the point that is lifted
  // crosses a new one.
  const std::vector<Vec3> ring{{1, 0, 0}, {0.6, 1, 0}, {-0.2, 1, 0.5}, {-1, 0.2, 0}, {0, -1, 0}};
  const double bound = fan_distance({0, 0, 0}, ring);
  const TriMesh before = fan({0, 0, 0}, ring, true), after = fan_after(ring);
  EXPECT_GT(bound, 0.05);
  EXPECT_GE(bound * (1 + 1e-9), farthest_sample(before, after));
}

TEST(FanDistance, IsZeroInAPlane) {
  const auto ring = rough_ring(7, 1, 0);
  EXPECT_NEAR(fan_distance({0.2, 0.1, 0}, ring), 0, 1e-15);
}

TEST(FanDistance, DoesNotDependOnSideOrPlace) {
  const auto ring = rough_ring(6, 5, 0.2);
  const Vec3 apex{0, 0.1, 0.1};
  const double bound = fan_distance(apex, ring);
  std::vector<Vec3> back{ring[0]};
  back.insert(back.end(), ring.rbegin(), ring.rend() - 1);
  EXPECT_NEAR(fan_distance(apex, back), bound, 1e-12);
  const auto moved = [](const Vec3& p) {
    return Vec3{0.36 * p.x + 0.48 * p.y - 0.8 * p.z + 17, -0.8 * p.x + 0.6 * p.y,
                0.48 * p.x + 0.64 * p.y + 0.6 * p.z - 5};
  };
  std::vector<Vec3> elsewhere;
  for (const Vec3& p : ring) elsewhere.push_back(moved(p));
  EXPECT_NEAR(fan_distance(moved(apex), elsewhere), bound, 1e-12);
}

TEST(FanDistance, IsUnknownWhereAFanFoldsOverItself) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // The ring has a notch that the apex sees, but not the point it is moved onto.
  const std::vector<Vec3> notch{{2, 0.1, 0}, {0.1, 0.2, 0}, {0, 2, 0}, {-1, -1, 0}};
  EXPECT_EQ(fan_distance({0, 0, 0}, notch), kInfinity);
  // Twice round the apex.
  auto ring = rough_ring(5, 2, 0);
  const auto once = ring;
  ring.insert(ring.end(), once.begin(), once.end());
  EXPECT_EQ(fan_distance({0, 0, 0}, ring), kInfinity);
  // No area.
  const std::vector<Vec3> line{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(fan_distance({0, 0, 0}, line), kInfinity);
}

}  // namespace
}  // namespace mesamis
