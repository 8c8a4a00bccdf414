// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <tuple>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/kuhn.h"
#include "mesamis/surface/extract.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

constexpr Box kUnit{{0, 0, 0}, {1, 1, 1}};

std::vector<double> sampled(const TetMesh& mesh, const std::function<double(const Vec3&)>& f) {
  std::vector<double> u;
  for (const Vec3& p : mesh.points) u.push_back(f(p));
  return u;
}

/// Volume of {u > level} cell by cell: linear functions on tetrahedra, by sorted values.
double volume_above(const TetMesh& mesh, const std::vector<double>& u, double level) {
  double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    std::array<double, 4> w;
    for (int i = 0; i < 4; ++i) w[i] = u[mesh.cells[c][i]] - level;
    std::sort(w.begin(), w.end(), std::greater<>());
    const double volume = cell_volume(mesh, static_cast<Index>(c));
    auto cut = [](double a, double b) { return a / (a - b); };  // share of the edge above
    const double corner = cut(w[0], w[1]) * cut(w[0], w[2]) * cut(w[0], w[3]);
    const double rest = cut(w[3], w[0]) * cut(w[3], w[1]) * cut(w[3], w[2]);
    if (w[3] > 0) sum += volume;
    if (w[0] > 0 && w[1] <= 0) sum += volume * corner;
    if (w[2] > 0 && w[3] <= 0) sum += volume * (1 - rest);
    if (w[1] > 0 && w[2] <= 0) {
      // A wedge: the corner at 0 without the part of it that lies beyond corner 1.
      const double s = cut(w[0], w[2]), t = cut(w[0], w[3]), p = cut(w[1], w[2]),
                   q = cut(w[1], w[3]);
      sum += volume * (s * t + p * q + s * q - s * t * q - s * p * q);
    }
  }
  return sum;
}

void expect_closed_manifold(const TriMesh& surface, const std::string& what) {
  const SurfaceCheck check = check_surface(surface);
  EXPECT_EQ(check.open_edges, 0) << what;
  EXPECT_EQ(check.nonmanifold_edges, 0) << what;
  EXPECT_EQ(check.nonmanifold_points, 0) << what;
  EXPECT_EQ(check.misoriented_edges, 0) << what;
  EXPECT_EQ(check.degenerate_triangles, 0) << what;
  EXPECT_TRUE(surface.triangles.empty() || check.volume > 0) << what;
}

TEST(ExtractSolid, IsClosedAndManifoldForRandomValues) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TetMesh mesh = perturbed_box({{-3, 2, 0}, {5, 3, 9}}, {5, 4, 6}, 0.2, seed);
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto u = sampled(mesh, [&](const Vec3&) { return uniform(generator); });
    const TriMesh surface = extract_solid(mesh, u, 0.1);
    expect_closed_manifold(surface, "seed " + std::to_string(seed));
  }
}

TEST(ExtractSolid, IsClosedAndManifoldForManyValuesAtTheLevel) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TetMesh mesh = box_mesh(kUnit, {5, 5, 5});
    std::mt19937 generator(seed);
    std::uniform_int_distribution<int> three(-1, 1);
    const auto u = sampled(mesh, [&](const Vec3&) { return three(generator); });
    expect_closed_manifold(extract_solid(mesh, u, 0), "seed " + std::to_string(seed));
  }
}

TEST(ExtractSolid, HasTheVolumeAboveTheLevel) {
  const TetMesh mesh = perturbed_box(kUnit, {6, 5, 4}, 0.2);
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto u = sampled(mesh, [&](const Vec3&) { return uniform(generator); });
  // What the margin at the ends of the edges costs is second order in it.
  EXPECT_NEAR(check_surface(extract_solid(mesh, u, 0.2)).volume, volume_above(mesh, u, 0.2), 1e-4);
}

TEST(ExtractSolid, AllSignsOfACell) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  for (unsigned signs = 0; signs < 16; ++signs) {
    std::vector<double> u;
    for (unsigned i = 0; i < 4; ++i) u.push_back((signs >> i & 1) != 0 ? 1.0 : -1.0);
    const TriMesh open = extract_solid(mesh, u, 0, {.close_at_box = false});
    const int count = __builtin_popcount(signs);
    EXPECT_EQ(open.triangles.size(), count % 4 == 0 ? 0u : count == 2 ? 2u : 1u);
    for (const Triangle& t : open.triangles) {
      // Each corner inside lies behind each triangle, each outside before it.
      const Vec3 &a = open.points[t[0]], &b = open.points[t[1]], &c = open.points[t[2]];
      for (unsigned i = 0; i < 4; ++i) {
        EXPECT_LT(u[i] * six_volume(a, b, c, mesh.points[i]), 1e-15) << signs << ' ' << i;
      }
    }
  }
}

TEST(ExtractSolid, AllSignsOfABrick) {
  const TetMesh mesh = box_mesh(kUnit, {1, 1, 1});
  for (unsigned signs = 0; signs < 256; ++signs) {
    std::vector<double> u;
    for (unsigned i = 0; i < 8; ++i) u.push_back((signs >> i & 1) != 0 ? 1.0 : -1.0);
    const TriMesh surface = extract_solid(mesh, u, 0);
    expect_closed_manifold(surface, "signs " + std::to_string(signs));
    EXPECT_NEAR(check_surface(surface).volume, volume_above(mesh, u, 0), 1e-14) << signs;
    EXPECT_TRUE(check_surface(extract_solid(mesh, u, 0, {.close_at_box = false})).manifold());
  }
}

TEST(ExtractSolid, AllSignsOfABrickAmidABox) {
  // All that can happen around one brick away from the box, at the level and off it.
  const TetMesh mesh = box_mesh(kUnit, {3, 3, 3});
  for (unsigned signs = 1; signs < 256; ++signs) {
    for (const double outside : {-1.0, 0.0}) {
      std::vector<double> u(mesh.points.size(), outside);
      for (unsigned i = 0; i < 8; ++i) {
        const unsigned node = (1 + (i >> 2)) * 16 + (1 + (i >> 1 & 1)) * 4 + 1 + (i & 1);
        if ((signs >> i & 1) != 0) u[node] = 1;
      }
      const TriMesh closed = extract_solid(mesh, u, 0);
      expect_closed_manifold(closed, "signs " + std::to_string(signs));
      const TriMesh open = extract_solid(mesh, u, 0, {.close_at_box = false});
      EXPECT_EQ(open.triangles, closed.triangles);  // nothing meets the box
    }
  }
}

TEST(ExtractSolid, OneNodeInsideIsABallAroundIt) {
  const TetMesh mesh = box_mesh(kUnit, {2, 2, 2});
  for (std::size_t node = 0; node < mesh.points.size(); ++node) {
    for (const double value : {1e-300, 1.0, 1e300}) {
      std::vector<double> u(mesh.points.size(), 0);
      u[node] = value;
      const TriMesh surface = extract_solid(mesh, u, 0);
      expect_closed_manifold(surface, "node " + std::to_string(node));
      EXPECT_EQ(check_surface(surface).components, 1);
    }
  }
}

TEST(ExtractSolid, EverywhereIsTheBoxAndNowhereIsNothing) {
  const Box box{{-1, 0, 2}, {1, 3, 7}};
  const TetMesh mesh = perturbed_box(box, {3, 4, 5}, 0.2);
  const std::vector<double> u(mesh.points.size(), 1);
  const TriMesh whole = extract_solid(mesh, u, 0);
  expect_closed_manifold(whole, "whole");
  EXPECT_EQ(bounding_box(whole.points), box);
  EXPECT_NEAR(check_surface(whole).volume, box.volume(), 1e-12);
  EXPECT_NEAR(check_surface(whole).area, 2 * (2 * 3 + 3 * 5 + 5 * 2), 1e-12);
  EXPECT_TRUE(extract_solid(mesh, u, 1).triangles.empty());  // at the level is outside
  EXPECT_TRUE(extract_solid(mesh, u, 1).points.empty());
  EXPECT_TRUE(extract_solid(mesh, u, 0, {.close_at_box = false}).points.empty());
}

TEST(ExtractSolid, APlaneIsExact) {
  const TetMesh mesh = perturbed_box(kUnit, {5, 5, 5}, 0.2);
  const Vec3 normal{0.36, 0.48, 0.8};
  const double offset = 0.77;
  const auto u = sampled(mesh, [&](const Vec3& p) { return offset - dot(normal, p); });
  const TriMesh surface = extract_solid(mesh, u, 0, {.close_at_box = false});
  ASSERT_GT(surface.triangles.size(), 10u);
  double shortest = 1;
  for (const Cell& cell : mesh.cells) {
    for (const auto& [i, j] : kCellEdges) {
      shortest = std::max(shortest, norm(mesh.points[cell[i]] - mesh.points[cell[j]]));
    }
  }
  for (const Vec3& p : surface.points) {
    // Exact but for crossings near a node, which keep their distance from it.
    EXPECT_NEAR(dot(normal, p), offset, kCrossingMargin * shortest);
  }
  for (const Triangle& t : surface.triangles) {
    const Vec3 n = cross(surface.points[t[1]] - surface.points[t[0]],
                         surface.points[t[2]] - surface.points[t[0]]);
    EXPECT_GT(dot(n, normal), 0);
  }
}

TEST(ExtractSolid, APlaneAwayFromTheNodesIsExactToRoundOff) {
  const TetMesh mesh = box_mesh(kUnit, {4, 4, 4});
  const auto u = sampled(mesh, [](const Vec3& p) { return 100 * (0.3 - p.z); });
  const TriMesh slab = extract_solid(mesh, u, 0);
  expect_closed_manifold(slab, "slab");
  const SurfaceCheck check = check_surface(slab);
  EXPECT_NEAR(check.volume, 0.3, 1e-14);
  EXPECT_NEAR(check.area, 2 + 4 * 0.3, 1e-14);
  EXPECT_NEAR(bounding_box(slab.points).hi.z, 0.3, 1e-15);
}

struct SphereErrors {
  double radius, area, volume;
};

SphereErrors sphere_errors(Index n) {
  const Vec3 center{0.01, -0.02, 0.03};
  const double radius = 0.7, pi = std::acos(-1.0);
  const TetMesh mesh = box_mesh({{-1, -1, -1}, {1, 1, 1}}, {n, n, n});
  const auto u = sampled(mesh, [&](const Vec3& p) { return -dot(p - center, p - center); });
  const TriMesh surface = extract_solid(mesh, u, -radius * radius);
  expect_closed_manifold(surface, "sphere");
  double worst = 0;
  for (const Vec3& p : surface.points) {
    worst = std::max(worst, std::abs(norm(p - center) - radius));
  }
  const SurfaceCheck check = check_surface(surface);
  EXPECT_EQ(check.components, 1);
  return {worst, std::abs(check.area - 4 * pi * radius * radius),
          std::abs(check.volume - 4 * pi / 3 * radius * radius * radius)};
}

TEST(ExtractSolid, ASphereConvergesAtSecondOrder) {
  const SphereErrors coarse = sphere_errors(12), fine = sphere_errors(24);
  EXPECT_LT(fine.radius, 0.01);
  EXPECT_NEAR(std::log2(coarse.area / fine.area), 2, 0.3);
  EXPECT_NEAR(std::log2(coarse.volume / fine.volume), 2, 0.3);
  EXPECT_NEAR(std::log2(coarse.radius / fine.radius), 2, 0.5);
}

TEST(ExtractSolid, PointsStayDistinctInSinglePrecision) {
  // Half a metre from the origin, every other value at the level or next to it.
  const TetMesh mesh = box_mesh({{480, -510, 300}, {488, -502, 308}}, {16, 16, 16});
  std::mt19937 generator(6);
  std::uniform_int_distribution<int> five(-2, 2);
  const auto u = sampled(mesh, [&](const Vec3&) {
    const int value = five(generator);
    return std::abs(value) == 2 ? value : value * 1e-14;
  });
  const TriMesh surface = extract_solid(mesh, u, 0);
  expect_closed_manifold(surface, "at the level");
  std::set<std::tuple<float, float, float>> places;
  for (const Vec3& p : surface.points) {
    places.insert({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  EXPECT_EQ(places.size(), surface.points.size());
}

TEST(ExtractSolid, TakesValuesOfAnySize) {
  const TetMesh mesh = box_mesh(kUnit, {3, 3, 3});
  constexpr double kLargest = std::numeric_limits<double>::max();
  constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
  for (const double size : {kLargest, kSmallest}) {
    std::mt19937 generator(1);
    std::uniform_int_distribution<int> three(-1, 1);
    const auto u = sampled(mesh, [&](const Vec3&) { return size * three(generator); });
    for (const double level : {-size, 0.0}) {
      expect_closed_manifold(extract_solid(mesh, u, level), std::to_string(size));
    }
  }
}

TEST(ExtractSolid, HasTheSameBytesForAnyNumberOfThreads) {
  const TetMesh mesh = perturbed_box(kUnit, {12, 12, 12}, 0.2);
  const auto u = sampled(mesh, [](const Vec3& p) { return std::sin(9 * p.x) + p.y * p.z; });
  const TriMesh one = with_threads(1, [&] { return extract_solid(mesh, u, 0.3); });
  const TriMesh three = with_threads(3, [&] { return extract_solid(mesh, u, 0.3); });
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.triangles, three.triangles);
}

TEST(ExtractSolid, RefusesValuesThatDoNotFit) {
  const TetMesh mesh = box_mesh(kUnit, {1, 1, 1});
  std::vector<double> u(8, 1);
  EXPECT_THROW(extract_solid(mesh, std::span(u).first(7), 0), InputError);
  EXPECT_THROW(extract_solid(mesh, u, std::nan("")), InputError);
  u[5] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(extract_solid(mesh, u, 0), InputError);
}

}  // namespace
}  // namespace mesamis
