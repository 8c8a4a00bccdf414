// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/extract_cubes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis {
namespace {

struct Grid {
  std::array<Index, 3> size;
  Vec3 spacing{1, 1, 1};
  std::vector<float> values{};

  template <class F>
  Grid filled(F f) const {
    Grid grid = *this;
    for (Index k = 0; k < size[2]; ++k) {
      for (Index j = 0; j < size[1]; ++j) {
        for (Index i = 0; i < size[0]; ++i) {
          grid.values.push_back(
              static_cast<float>(f(Vec3{i * spacing.x, j * spacing.y, k * spacing.z})));
        }
      }
    }
    return grid;
  }
  TriMesh extract(double level) const { return extract_cubes({size, spacing, values}, level); }
};

/// Everything extract_cubes() promises for any values.
void expect_sound(const TriMesh& surface) {
  const SurfaceCheck check = check_surface(surface);
  EXPECT_EQ(flaws_of(check), "");
  EXPECT_TRUE(find_self_intersections(surface).empty());
}

TEST(ExtractCubes, IsClosedAndDoesNotCutItselfForAnyValues) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    const Grid grid =
        Grid{{6, 7, 8}, {1, 0.5, 2}}.filled([&](const Vec3&) { return any(generator); });
    for (const double level : {-0.6, 0.0, 0.6}) {
      const TriMesh surface = grid.extract(level);
      expect_sound(surface);
      EXPECT_GT(check_surface(surface).volume, 0) << seed;
    }
  }
}

TEST(ExtractCubes, IsSoundForEachOfTheCubesWithNodesAboveTheLevel) {
  for (unsigned inside = 1; inside < 256; ++inside) {
    const Grid grid = Grid{{4, 4, 4}}.filled([inside](const Vec3& p) {
      const auto bit = static_cast<unsigned>(p.x - 1 + 2 * (p.y - 1) + 4 * (p.z - 1));
      const bool in_cube = std::min({p.x, p.y, p.z}) >= 1 && std::max({p.x, p.y, p.z}) <= 2;
      return in_cube && ((inside >> bit) & 1U) != 0 ? 1.0 : -1.0;
    });
    const TriMesh surface = grid.extract(0.2);
    expect_sound(surface);
    EXPECT_GT(check_surface(surface).volume, 0) << inside;
  }
}

TEST(ExtractCubes, FindsABallToTheSecondOrder) {
  const auto volume_error = [](Index n) {
    const double h = 4.0 / (n - 1);
    const Grid grid = Grid{{n, n, n}, {h, h, h}}.filled([](const Vec3& p) {
      return 1 - norm(p - Vec3{2.01, 1.98, 2.03});
    });
    return std::abs(check_surface(grid.extract(0)).volume - 4.0 / 3 * std::numbers::pi);
  };
  EXPECT_LT(volume_error(41), 0.03);
  EXPECT_NEAR(volume_error(41) / volume_error(81), 4, 1);
}

TEST(ExtractCubes, PlacesPointsWhereALinearFunctionCrosses) {
  const Grid grid =
      Grid{{9, 9, 9}, {1, 2, 0.5}}.filled([](const Vec3& p) { return p.x + 0.3 * p.y - p.z; });
  for (const Vec3& p : grid.extract(2.2).points) {
    // Caps and bevels lie in the outermost cubes.
    const bool in_middle = p.x > 1 && p.x < 7 && p.y > 2 && p.y < 14 && p.z > 0.5 && p.z < 3.5;
    if (!in_middle) continue;
    EXPECT_NEAR(p.x + 0.3 * p.y - p.z, 2.2, 0.03);
  }
}

TEST(ExtractCubes, CapsWhatReachesTheBox) {
  const Grid grid = Grid{{8, 9, 10}}.filled([](const Vec3&) { return 1.0; });
  const TriMesh surface = grid.extract(0);
  expect_sound(surface);
  // The box but for the bevels along its twelve edges: prisms of half a cube each.
  const double box = 7.0 * 8 * 9, bevels = 4 * 0.5 * (7 + 8 + 9);
  EXPECT_LT(check_surface(surface).volume, box);
  EXPECT_GT(check_surface(surface).volume, box - bevels);
  const Box bounds = bounding_box(surface.points);
  EXPECT_EQ(bounds.lo, (Vec3{0, 0, 0}));
  EXPECT_EQ(bounds.hi, (Vec3{7, 8, 9}));
}

TEST(ExtractCubes, GivesTheSameForAnyNumberOfThreads) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const Grid grid = Grid{{20, 21, 22}}.filled([&](const Vec3&) { return any(generator); });
  const TriMesh one = with_threads(1, [&] { return grid.extract(0); });
  const TriMesh three = with_threads(3, [&] { return grid.extract(0); });
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.triangles, three.triangles);
}

TEST(ExtractCubes, IsEmptyWhereNothingIsAbove) {
  const Grid grid = Grid{{4, 4, 4}}.filled([](const Vec3&) { return 1.0; });
  EXPECT_TRUE(grid.extract(1).triangles.empty());
}

TEST(ExtractCubes, RefusesWhatIsNoGrid) {
  Grid grid = Grid{{4, 4, 4}}.filled([](const Vec3& p) { return p.x; });
  EXPECT_THROW(grid.extract(std::numeric_limits<double>::quiet_NaN()), InputError);
  grid.values[5] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(grid.extract(1), InputError);
  grid.values.pop_back();
  EXPECT_THROW(grid.extract(1), InputError);
  EXPECT_THROW((Grid{{1, 4, 4}, {1, 1, 1}, std::vector<float>(16)}.extract(1)), InputError);
}

}  // namespace
}  // namespace mesamis
