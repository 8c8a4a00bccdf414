// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/fan_height.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "decimate/collapses.h"
#include "mesamis/surface/distance.h"

namespace mesamis {
namespace {

/// A plane of triangles, lifted by noise.
TriMesh rough_plane(unsigned seed, double roughness) {
  constexpr Index n = 7;
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> around(-1, 1);
  TriMesh mesh;
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      mesh.points.push_back({i + 0.2 * around(generator), j + 0.2 * around(generator),
                             roughness * around(generator)});
    }
  }
  for (Index j = 0; j + 1 < n; ++j) {
    for (Index i = 0; i + 1 < n; ++i) {
      const Index p = j * n + i;
      mesh.triangles.push_back({p, p + 1, p + n + 1});
      mesh.triangles.push_back({p, p + n + 1, p + n});
    }
  }
  return mesh;
}

/// Calls visit(collapse, before, after) for the inner edges: only what changes of both surfaces.
template <class Visit>
void for_each_inner(const TriMesh& mesh, Visit visit) {
  const Collapses now(mesh);
  for (Index h = 0; h < 3 * now.surface.count(); ++h) {
    if (!now.surface.is_inner(now.surface.from(h)) || !now.surface.is_inner(now.surface.to(h)))
      continue;
    if (now.surface.opposite(h) == kNoIndex || !now.surface.may_collapse(h)) continue;
    for (const double share : {0.0, 0.3, 0.5}) {
      const Vec3 &a = mesh.points[now.surface.from(h)], &b = mesh.points[now.surface.to(h)];
      Collapse collapse;
      describe(now.surface, mesh.points, h, b + share * (a - b), collapse);
      TriMesh before{mesh.points, {}}, after{mesh.points, {}};
      after.points[collapse.kept] = collapse.place;
      for (std::size_t i = 0; i < collapse.faces.size(); ++i) {
        before.triangles.push_back(now.surface.triangle(collapse.faces[i]));
        const Index o = collapse.outer[i];
        after.triangles.push_back({collapse.kept, now.surface.from(o), now.surface.to(o)});
      }
      for (const Index t : collapse.gone()) before.triangles.push_back(now.surface.triangle(t));
      visit(fan_height(now.surface, mesh.points, collapse), before, after);
    }
  }
}

TEST(FanHeight, BoundsTheDistancesInBothDirections) {
  int finite = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    for_each_inner(rough_plane(seed, 0.3),
                   [&](double height, const TriMesh& before, const TriMesh& after) {
                     if (std::isinf(height)) return;
                     ++finite;
                     EXPECT_LE(max_distance(before, after, 1e-3), height * 1.005 + 1e-3);
                     EXPECT_LE(max_distance(after, before, 1e-3), height * 1.005 + 1e-3);
                   });
  }
  EXPECT_GT(finite, 200);
}

TEST(FanHeight, IsZeroInAPlane) {
  int seen = 0;
  for_each_inner(rough_plane(1, 0), [&](double height, const TriMesh&, const TriMesh&) {
    if (std::isinf(height)) return;
    ++seen;
    EXPECT_NEAR(height, 0, 1e-12);
  });
  EXPECT_GT(seen, 50);
}

TEST(FanHeight, IsInfiniteWhereTrianglesTurnOver) {
  const TriMesh mesh = rough_plane(1, 0);
  const Collapses now(mesh);
  for (Index h = 0; h < 3 * now.surface.count(); ++h) {
    if (!now.surface.is_inner(now.surface.from(h)) || !now.surface.is_inner(now.surface.to(h)))
      continue;
    if (!now.surface.may_collapse(h)) continue;
    Collapse collapse;
    describe(now.surface, mesh.points, h, {20, 20, 0}, collapse);  // far outside of the rim
    EXPECT_TRUE(std::isinf(fan_height(now.surface, mesh.points, collapse)));
  }
}

}  // namespace
}  // namespace mesamis
