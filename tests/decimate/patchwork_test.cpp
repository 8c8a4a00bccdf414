// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/patchwork.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/unused_points.h"
#include "support/level_set.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

constexpr Box kBox{{-1, -1, -1}, {1, 1, 1}};

TriMesh torus() {
  return level_set(kBox, {20, 20, 20}, [](const Vec3& p) {
    return 0.25 - std::hypot(std::hypot(p.x, p.y) - 0.6, p.z);
  });
}

/// One of two bodies with a wavy gap between them that is narrower than the tolerance below: the
/// lower one (-1) or the upper one (1).
TriMesh neighbours(int which) {
  const Index n = which > 0 ? 17 : 15;
  return level_set(kBox, {n, n, n}, [which](const Vec3& p) {
    const double wave = 0.15 * std::sin(8 * p.x) * std::cos(7 * p.y);
    return std::min({0.8 - std::abs(p.x), 0.8 - std::abs(p.y), 0.5 - std::abs(p.z),
                     which * (p.z - wave) - 0.02});
  });
}

struct Work {
  TriMesh surface;
  DecimateTask task;
  PatchworkReport report{};

  Work(TriMesh s, double tolerance)
      : surface(std::move(s)), task{surface, tolerance, 0, [](double) {}} {}

  Cover run(double side) {
    return decimate_patchwork(task, surface.points, cut_into_patches(cover_of(surface), side),
                              report);
  }

  void expect_promises_kept(const Cover& cover) const {
    const TriMesh result = without_unused_points({cover.points, cover.triangles});
    const SurfaceCheck before = check_surface(surface), after = check_surface(result);
    EXPECT_EQ(flaws_of(after), "");
    EXPECT_EQ(after.components, before.components);
    EXPECT_TRUE(find_self_intersections(result).empty());
    EXPECT_LE(max_distance(result, surface, 1e-4), task.tolerance * kDistanceSlack);
    EXPECT_LE(max_distance(surface, result, 1e-4), task.tolerance * kDistanceSlack);
  }
};

TEST(Patchwork, KeepsThePromisesOfDecimation) {
  Work work(torus(), 0.02);
  const Cover cover = work.run(1);
  work.expect_promises_kept(cover);
  EXPECT_LT(cover.triangles.size(), work.surface.triangles.size() / 2);
}

/// The patch of the triangles over some consecutive points, which share none with others.
Patch part(const TriMesh& surface, Index begin, Index end) {
  Patch patch;
  for (Index p = begin; p < end; ++p) patch.points.push_back(p);
  patch.held.assign(patch.points.size(), 0);
  for (Index t = 0; t < std::ssize(surface.triangles); ++t) {
    const Triangle& k = surface.triangles[t];
    if (k[0] < begin || k[0] >= end) continue;
    patch.cover.triangles.push_back({k[0] - begin, k[1] - begin, k[2] - begin});
    patch.cover.originals.push_back({t});
    patch.cover.to_originals.push_back(0);
    patch.cover.from_originals.push_back(0);
  }
  for (const Index p : patch.points) patch.cover.points.push_back(surface.points[p]);
  return patch;
}

TEST(Patchwork, PatchesThatWouldMeetAreMadeAnew) {
  const TriMesh lower = neighbours(-1);
  const Work work(joined(lower, neighbours(1)), 0.3);
  ASSERT_TRUE(find_self_intersections(work.surface).empty());
  const auto first = static_cast<Index>(lower.points.size());
  const auto end = static_cast<Index>(work.surface.points.size());
  const std::vector<Patch> patches{part(work.surface, 0, first), part(work.surface, first, end)};
  // Each for itself, they meet.
  TriMesh apart{work.surface.points, {}};
  for (const Patch& patch : patches) {
    const Cover done = decimate_pass(work.task, patch);
    for (std::size_t p = 0; p < patch.points.size(); ++p) {
      apart.points[patch.points[p]] = done.points[p];
    }
    for (Triangle t : done.triangles) {
      for (Index& p : t) p = patch.points[p];
      apart.triangles.push_back(t);
    }
  }
  EXPECT_FALSE(find_self_intersections(apart).empty());
  PatchworkReport report;
  const Cover cover = decimate_patchwork(work.task, work.surface.points, patches, report);
  work.expect_promises_kept(cover);
  EXPECT_GT(report.rounds, 0);
  EXPECT_LT(cover.triangles.size(), work.surface.triangles.size() * 3 / 4);
}

/// Some points of one body or of both may go; what is not near them is held as a whole, however near
/// it lies to what moves.
TEST(Patchwork, ARestStaysAndIsNotMet) {
  const TriMesh lower = neighbours(-1);
  Work work(joined(lower, neighbours(1)), 0.3);
  int met = 0;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<char> open(work.surface.points.size(), 0);
    const Vec3 center{0.13 * trial - 0.8, 0.7 - 0.11 * trial, 0};
    for (std::size_t p = 0; p < open.size(); ++p) {
      const bool is_lower = p < lower.points.size();
      if ((trial % 3 == 0 && !is_lower) || (trial % 3 == 1 && is_lower)) continue;
      const Vec3 away = work.surface.points[p] - center;
      open[p] = std::abs(away.x) + std::abs(away.y) < 0.5 + 0.05 * trial ? 1 : 0;
    }
    std::vector<char> around = open;
    choose_rings(work.surface.triangles, 2, around);
    std::vector<Patch> patches =
        cut_into_patches(cover_of(work.surface), trial % 2 == 0 ? 0.7 : 1e9, around);
    const std::size_t rest = patches.back().cover.triangles.size();
    ASSERT_GT(rest, 100u);
    for (Patch& patch : patches) {
      for (std::size_t i = 0; i < patch.points.size(); ++i) {
        if (open[patch.points[i]] == 0) patch.held[i] = 1;
      }
    }
    PatchworkReport report;
    const Cover cover = decimate_patchwork(work.task, work.surface.points, patches, report);
    work.expect_promises_kept(cover);
    EXPECT_GE(cover.triangles.size(), rest);
    EXPECT_LT(cover.triangles.size(), work.surface.triangles.size());
    met += report.rounds > 0 ? 1 : 0;
  }
  EXPECT_GT(met, 0) << "no trial tests anything";
}

TEST(Patchwork, IsTheSameForAnyNumberOfThreads) {
  Work work(torus(), 0.02);
  const auto run = [&] { return work.run(0.5); };
  const Cover one = with_threads(1, run), three = with_threads(3, run);
  EXPECT_EQ(one.triangles, three.triangles);
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.originals, three.originals);
}

}  // namespace
}  // namespace mesamis
