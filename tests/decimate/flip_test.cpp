// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/flip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "decimate/collapses.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/farthest.h"

namespace mesamis {
namespace {

/// Of all edges: length times one less the cosine of the bend.
double bends_of(const EditableSurface& surface, const std::vector<Vec3>& points) {
  const std::vector<Vec3> normals = normals_of(surface, points);
  double sum = 0;
  for (Index h = 0; h < 3 * surface.count(); ++h) {
    const Index o = surface.opposite(h);
    if (o < h) continue;
    sum += norm(points[surface.to(h)] - points[surface.from(h)]) *
           (1 - dot(normals[h / 3], normals[o / 3]));
  }
  return sum;
}

/// A roof, z = -|x - y|, of which each square on the ridge is cut along it or across it.
TriMesh roof(bool across) {
  constexpr Index kSide = 5;
  TriMesh mesh;
  for (Index j = 0; j < kSide; ++j) {
    for (Index i = 0; i < kSide; ++i) {
      mesh.points.push_back({1.0 * i, 1.0 * j, -std::abs(1.0 * i - j)});
    }
  }
  for (Index j = 0; j + 1 < kSide; ++j) {
    for (Index i = 0; i + 1 < kSide; ++i) {
      const Index a = i + kSide * j, b = a + 1, c = a + kSide + 1, d = a + kSide;
      if (across && i == j) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      }
    }
  }
  return mesh;
}

TEST(Flip, IsDescribedAsItWillBe) {
  Collapses now(small_sphere());
  int flips = 0;
  for (Index h = 0; h < 3 * now.surface.count(); ++h) {
    if (!now.surface.may_flip(h)) continue;
    const TriMesh before = now.now();
    const Flip flip = describe_flip(now.surface, now.points, h);
    now.surface.flip(h);
    TriMesh old{now.points, {}}, fresh{now.points, {}};
    for (std::size_t i = 0; i < 2; ++i) {
      const Triangle t = now.surface.triangle(flip.faces[i]);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(flip.after[i][k], now.points[t[k]]);
      old.triangles.push_back(before.triangles[flip.faces[i]]);
      fresh.triangles.push_back(t);
    }
    if (std::isfinite(flip.height)) {
      ++flips;
      const double apart = std::max(max_distance(old, fresh, 1e-6), max_distance(fresh, old, 1e-6));
      EXPECT_LE(apart, flip.height + 1e-5);
    }
    now.surface.flip_back(h);
  }
  EXPECT_GT(flips, 100);
}

TEST(Flip, HasTheHeightOfATetrahedron) {
  const std::vector<Vec3> points{{0, 0, 0}, {2, 0, 0}, {1, 1, 0.5}, {1, -1, 0.5}};
  const EditableSurface surface(4, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_DOUBLE_EQ(describe_flip(surface, points, 0).height, 0.5);
  const std::vector<Vec3> beyond{{0, 0, 0}, {2, 0, 0}, {1, 1, 0.5}, {5, -1, 0.5}};
  EXPECT_TRUE(std::isinf(describe_flip(surface, beyond, 0).height)) << "edges do not cross";
}

TEST(Flip, SmoothsWhereTheBendsOfTheWholeSurfaceFall) {
  Collapses now(small_sphere());
  for (std::size_t p = 0; p < now.points.size(); ++p) {
    now.points[p] = (1 + 0.05 * std::sin(50.0 * static_cast<double>(p))) * now.points[p];
  }
  int smoother = 0;
  for (Index h = 0; h < 3 * now.surface.count(); ++h) {
    if (!now.surface.may_flip(h)) continue;
    const Flip flip = describe_flip(now.surface, now.points, h);
    const double before = bends_of(now.surface, now.points);
    const bool does = smooths(now.surface, now.points, normals_of(now.surface, now.points), flip);
    now.surface.flip(h);
    const double after = bends_of(now.surface, now.points);
    if (does) {
      EXPECT_LT(after, before);
      ++smoother;
    } else {
      now.surface.flip_back(h);
    }
  }
  EXPECT_GT(smoother, 20);
}

TEST(Flip, PutsEdgesAlongARidge) {
  const TriMesh across = roof(true), along = roof(false);
  EditableSurface surface(across.points.size(), across.triangles);
  int flips = 0;
  for (Index h = 0; h < 3 * surface.count(); ++h) {
    if (surface.opposite(h) < h || !surface.may_flip(h)) continue;
    if (!smooths(surface, across.points, normals_of(surface, across.points),
                 describe_flip(surface, across.points, h))) {
      continue;
    }
    surface.flip(h);
    ++flips;
  }
  EXPECT_GE(flips, 4);
  EXPECT_LE(bends_of(surface, across.points),
            bends_of(EditableSurface(along.points.size(), along.triangles), along.points) + 1e-12);
  int on_ridge = 0;
  for (Index h = 0; h < 3 * surface.count(); ++h) {
    const Vec3 &a = across.points[surface.from(h)], &b = across.points[surface.to(h)];
    if (surface.opposite(h) > h && a.z == 0 && b.z == 0) ++on_ridge;
  }
  EXPECT_EQ(on_ridge, 4);
}

TEST(Flip, SmoothsNothingIfATriangleLosesItsHeightOrTurnsOver) {
  const auto smooths_at = [](const std::vector<Vec3>& points) {
    const EditableSurface surface(4, {{0, 1, 2}, {1, 0, 3}});
    return smooths(surface, points, normals_of(surface, points), describe_flip(surface, points, 0));
  };
  EXPECT_TRUE(smooths_at({{0, 0, 0}, {2, 0, 0}, {1, 0.3, 0.1}, {1, -0.3, 0.1}}));
  EXPECT_FALSE(smooths_at({{0, 0, 0}, {2, 0, 0}, {2, 0.3, 0.1}, {2.0001, -0.3, 0.1}})) << "flat";
  EXPECT_FALSE(smooths_at({{0, 0, 0}, {2, 0, 0}, {1, 0.3, 2}, {1, -0.3, 2}})) << "turns";
}

}  // namespace
}  // namespace mesamis
