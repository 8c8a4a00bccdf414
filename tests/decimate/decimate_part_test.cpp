// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "mesamis/base/parallel.h"
#include "mesamis/decimate/decimation.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/unused_points.h"
#include "support/level_set.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kTolerance = 0.02;

TriMesh sphere() {
  return level_set({{-1, -1, -1}, {1, 1, 1}}, {20, 20, 20},
                   [](const Vec3& p) { return 0.8 - norm(p); });
}

/// The triangles of a cover whose centres are chosen.
Cover some_of(const TriMesh& surface, const Cover& cover,
              const std::function<bool(const Vec3&)>& choose) {
  Cover some;
  some.points = surface.points;
  for (std::size_t t = 0; t < cover.triangles.size(); ++t) {
    const Triangle& k = cover.triangles[t];
    if (!choose((1.0 / 3) * (surface.points[k[0]] + surface.points[k[1]] + surface.points[k[2]]))) {
      continue;
    }
    some.triangles.push_back(k);
    some.originals.push_back(cover.originals[t]);
    some.to_originals.push_back(cover.to_originals[t]);
    some.from_originals.push_back(cover.from_originals[t]);
  }
  return some;
}

/// Of each point 1 if it is nearer than 0.15 to the plane between the halves.
std::vector<char> held_at_middle(const TriMesh& surface) {
  std::vector<char> held;
  for (const Vec3& p : surface.points) held.push_back(std::abs(p.z) < 0.15 ? 1 : 0);
  return held;
}

Cover halves_decimated(const TriMesh& surface) {
  Cover both;
  both.points = surface.points;
  for (const double sign : {-1.0, 1.0}) {
    const Cover half =
        some_of(surface, cover_of(surface), [&](const Vec3& p) { return sign * p.z > 0; });
    const Cover done = decimate_part(surface, half, held_at_middle(surface), {kTolerance});
    for (std::size_t p = 0; p < both.points.size(); ++p) {
      if (done.points[p] != surface.points[p]) both.points[p] = done.points[p];
    }
    both.triangles.insert(both.triangles.end(), done.triangles.begin(), done.triangles.end());
    both.originals.insert(both.originals.end(), done.originals.begin(), done.originals.end());
    both.to_originals.insert(both.to_originals.end(), done.to_originals.begin(),
                             done.to_originals.end());
    both.from_originals.insert(both.from_originals.end(), done.from_originals.begin(),
                               done.from_originals.end());
  }
  return both;
}

void expect_near_and_sound(const TriMesh& surface, const Cover& cover) {
  const TriMesh result = without_unused_points({cover.points, cover.triangles});
  EXPECT_EQ(flaws_of(check_surface(result)), "");
  EXPECT_TRUE(find_self_intersections(result).empty());
  EXPECT_LE(max_distance(result, surface, 1e-4), kTolerance);
  EXPECT_LE(max_distance(surface, result, 1e-4), kTolerance);
}

std::size_t near_middle(const TriMesh& surface, const std::vector<Triangle>& triangles) {
  const std::vector<char> held = held_at_middle(surface);
  return static_cast<std::size_t>(std::count_if(
      triangles.begin(), triangles.end(),
      [&](const Triangle& t) { return held[t[0]] != 0 && held[t[1]] != 0 && held[t[2]] != 0; }));
}

TEST(DecimatePart, PartsWhoseCommonPointsAreHeldStillFit) {
  const TriMesh surface = sphere();
  const Cover both = halves_decimated(surface);
  expect_near_and_sound(surface, both);
  EXPECT_LT(both.triangles.size(), surface.triangles.size() / 2);
  EXPECT_GE(near_middle(surface, both.triangles), near_middle(surface, surface.triangles))
      << "triangles that are held stay";
}

// What was held may be decimated later, within the tolerance of the original.
TEST(DecimatePart, GoesOnFromWhatIsDecimated) {
  const TriMesh surface = sphere();
  const Cover both = halves_decimated(surface);
  std::vector<char> held;
  for (const Vec3& p : surface.points) held.push_back(std::abs(p.z) < 0.3 ? 0 : 1);
  const std::size_t before = near_middle(surface, both.triangles);
  const Cover done = decimate_part(surface, both, held, {kTolerance});
  expect_near_and_sound(surface, done);
  EXPECT_LT(near_middle(surface, done.triangles), before / 4);
  // An original lies near triangles of several patches: none of them would be near enough alone.
  EXPECT_EQ(decimate_patches(surface, both, held, {kTolerance}, 500).triangles, done.triangles);
}

TEST(DecimatePart, TheSameForAnyNumberOfThreads) {
  const TriMesh surface = sphere();
  const Cover one = with_threads(1, [&] { return halves_decimated(surface); });
  const Cover three = with_threads(3, [&] { return halves_decimated(surface); });
  EXPECT_EQ(one.triangles, three.triangles);
  EXPECT_EQ(one.originals, three.originals);
}

TEST(DecimatePart, NothingStaysNothing) {
  EXPECT_TRUE(decimate_part({}, {}, {}, {kTolerance}).triangles.empty());
}

TEST(DecimatePart, RefusesWhatOnlyAWholeCanHave) {
  const TriMesh surface = sphere();
  const std::vector<char> held(surface.points.size(), 0);
  const auto refused = [&](const DecimateOptions& options) {
    EXPECT_REFUSED(decimate_part(surface, cover_of(surface), held, options),
                   HasSubstr("finite tolerance"));
  };
  refused({.tolerance = std::numeric_limits<double>::infinity()});
  refused({.tolerance = 0});
  refused({.tolerance = kTolerance, .triangles = 100});
}

}  // namespace
}  // namespace mesamis
