// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/snap_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_tree.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

constexpr Box kBox{{0, 0, 0}, {8, 8, 8}};
constexpr double kEverywhere = 100;  // a distance that holds nothing back

template <class Function>
std::vector<double> sampled(const TetMesh& mesh, const Function& f) {
  std::vector<double> u;
  for (const Vec3& p : mesh.points) u.push_back(f(p));
  return u;
}

/// Twice the number of parts less the number of handles, and so on: what moving nodes must not change.
std::int64_t euler_characteristic(const TriMesh& surface) {
  return std::ssize(surface.points) - std::ssize(surface.triangles) / 2;
}

/// The surface with nodes moved is one that the surface without could be bent into.
void expect_same_shape(const TetMesh& mesh, const std::vector<double>& u, double distance,
                       const std::string& what) {
  const TriMesh plain = extract_solid(mesh, u, 0);
  const TriMesh snapped = extract_solid(mesh, u, 0, {.snap = distance});
  ASSERT_EQ(snapped.triangles.empty(), plain.triangles.empty()) << what;
  if (plain.triangles.empty()) return;  // between the nodes
  const SurfaceCheck check = check_surface(snapped);
  EXPECT_EQ(solid_flaws_of(check), "") << what;
  EXPECT_TRUE(find_self_intersections(snapped).empty()) << what;
  const SurfaceCheck before = check_surface(plain);
  EXPECT_EQ(check.islands, before.islands) << what;
  EXPECT_EQ(check.cavities, before.cavities) << what;
  EXPECT_EQ(euler_characteristic(snapped), euler_characteristic(plain)) << what;
}

TEST(SnapNodes, KeepsTheTopologyOfRandomValues) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TetMesh mesh = perturbed_box(kBox, {8, 8, 8}, 0.2, seed);
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto u = sampled(mesh, [&](const Vec3&) { return uniform(generator); });
    expect_same_shape(mesh, u, kEverywhere, "seed " + std::to_string(seed));
  }
}

TEST(SnapNodes, KeepsTheTopologyOfThinSheetsAndThreads) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TetMesh mesh = perturbed_box(kBox, {16, 16, 16}, 0.2, seed);
    for (const double thickness : {0.05, 0.3, 0.6}) {
      const auto sheet = sampled(mesh, [&](const Vec3& p) {
        return thickness - std::abs(p.x + 0.3 * p.y + std::sin(p.z) - 6);
      });
      expect_same_shape(mesh, sheet, kEverywhere, "sheet, seed " + std::to_string(seed));
      const auto thread = sampled(mesh, [&](const Vec3& p) {
        return thickness - std::hypot(p.x - 4 - std::sin(p.z), p.y - 4 + 0.2 * p.z);
      });
      expect_same_shape(mesh, thread, kEverywhere, "thread, seed " + std::to_string(seed));
    }
  }
}

TEST(SnapNodes, KeepsTheTopologyOfManyValuesAtTheLevel) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TetMesh mesh = box_mesh(kBox, {5, 5, 5});
    std::mt19937 generator(seed);
    std::uniform_int_distribution<int> three(-1, 1);
    const auto u = sampled(mesh, [&](const Vec3&) { return three(generator); });
    const TriMesh surface = extract_solid(mesh, u, 0, {.snap = kEverywhere});
    EXPECT_EQ(solid_flaws_of(check_surface(surface)), "") << "seed " << seed;
  }
}

TEST(SnapNodes, CarriesAPlaneOnFewTrianglesExactly) {
  const TetMesh mesh = perturbed_box(kBox, {10, 10, 10}, 0.2, 3);
  const auto height = [](const Vec3& p) { return 4.3 - p.z - 0.3 * p.x + 0.1 * p.y; };
  const auto u = sampled(mesh, height);
  const TriMesh plain = extract_solid(mesh, u, 0, {.close_at_box = false});
  const TriMesh snapped = extract_solid(mesh, u, 0, {.close_at_box = false, .snap = 1e-9});
  for (const Vec3& p : snapped.points) EXPECT_NEAR(height(p), 0, 1e-12);
  EXPECT_LT(2 * snapped.triangles.size(), plain.triangles.size());
}

double distance_to(const TriMesh& surface, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [i, j, k] : surface.triangles) {
    const Corners corners{surface.points[i], surface.points[j], surface.points[k]};
    least = std::min(least, squared_distance(p, corners));
  }
  return std::sqrt(least);
}

TEST(SnapNodes, KeepsAllCrossingsWithinTheDistance) {
  const TetMesh mesh = perturbed_box(kBox, {16, 16, 16}, 0.2, 4);
  const auto u = sampled(mesh, [](const Vec3& p) { return 3 - norm(p - Vec3{4, 4, 4}); });
  const TriMesh plain = extract_solid(mesh, u, 0);
  std::size_t before = plain.triangles.size();
  for (const double distance : {0.005, 0.02, 0.08}) {
    const TriMesh snapped = extract_solid(mesh, u, 0, {.snap = distance});
    EXPECT_LT(snapped.triangles.size(), before) << distance;
    for (const Vec3& p : plain.points) EXPECT_LE(distance_to(snapped, p), distance * (1 + 1e-9));
    before = snapped.triangles.size();
  }
}

TEST(SnapNodes, LeavesTheNodesOfTheRim) {
  const TetMesh mesh = perturbed_box(kBox, {6, 6, 6}, 0.2, 5);
  const auto u = sampled(mesh, [](const Vec3& p) { return 4.1 - p.z; });
  const SnappedNodes snapped = snap_nodes(mesh, u, 0, kEverywhere);
  std::size_t moved = 0;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const bool on_rim = planes_of(kBox, mesh.points[n]) != 0;
    if (snapped.on_level[n] == 0 || on_rim) {
      EXPECT_EQ(snapped.points[n], mesh.points[n]);
      EXPECT_EQ(snapped.on_level[n], 0);
    } else {
      ++moved;
    }
  }
  EXPECT_GT(moved, 10U);
}

TEST(SnapNodes, HasTheSameBytesForAnyNumberOfThreads) {
  const TetMesh mesh = perturbed_box(kBox, {20, 20, 20}, 0.2, 6);
  const auto u = sampled(mesh, [](const Vec3& p) { return std::sin(p.x) + std::cos(p.y * p.z); });
  const SnappedNodes one = with_threads(1, [&] { return snap_nodes(mesh, u, 0, 0.1); });
  const SnappedNodes three = with_threads(3, [&] { return snap_nodes(mesh, u, 0, 0.1); });
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.on_level, three.on_level);
}

}  // namespace
}  // namespace mesamis
