// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/sampling.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_tree.h"
#include "support/edge_lengths.h"
#include "support/level_set.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

constexpr Box kBox{{-1, -1, -1}, {1, 1, 1}};

TriMesh sphere(Index n = 16) {
  return level_set(kBox, {n, n, n}, [](const Vec3& p) { return 0.8 - norm(p); });
}

TriMesh torus(Index n = 20) {
  return level_set(kBox, {n, n, n}, [](const Vec3& p) {
    const double around = std::hypot(p.x, p.y) - 0.6;
    return 0.25 - std::hypot(around, p.z);
  });
}

double farthest_sample(const TriMesh& from, const TriMesh& to) {
  const auto at_points = distances_to_surface(from.points, to);
  const auto by_area = distances_to_surface(sample_by_area(from, 20'000), to);
  return std::max(*std::max_element(at_points.begin(), at_points.end()),
                  *std::max_element(by_area.begin(), by_area.end()));
}

/// Everything decimate() promises, looked at from outside.
DecimateReport expect_promises_kept(const TriMesh& surface, const TriMesh& result,
                                    const DecimateReport& report, double tolerance) {
  const SurfaceCheck before = check_surface(surface), after = check_surface(result);
  EXPECT_TRUE(after.closed());
  EXPECT_TRUE(after.manifold());
  EXPECT_EQ(after.components, before.components);
  auto euler = [](const TriMesh& s) {
    return static_cast<std::int64_t>(s.points.size()) -
           static_cast<std::int64_t>(s.triangles.size()) / 2;
  };
  EXPECT_EQ(euler(result), euler(surface));
  EXPECT_TRUE(find_self_intersections(result).empty());
  EXPECT_LE(report.original_to_result, tolerance);
  EXPECT_LE(report.result_to_original, tolerance);
  EXPECT_LE(farthest_sample(surface, result), report.original_to_result * (1 + 1e-9));
  EXPECT_LE(farthest_sample(result, surface), report.result_to_original * (1 + 1e-9));
  EXPECT_EQ(report.triangles_after, static_cast<std::int64_t>(result.triangles.size()));
  return report;
}

DecimateReport expect_decimated(const TriMesh& surface, double tolerance) {
  DecimateReport report;
  const TriMesh result = decimate(surface, {.tolerance = tolerance}, &report);
  return expect_promises_kept(surface, result, report, tolerance);
}

TEST(Decimate, ASphereKeepsItsVolumeWithFewTriangles) {
  const TriMesh surface = sphere(24);
  DecimateReport report;
  const TriMesh result = decimate(surface, {.tolerance = 0.02}, &report);
  expect_promises_kept(surface, result, report, 0.02);
  EXPECT_LT(report.triangles_after, report.triangles_before / 4);
  const double expected = check_surface(surface).volume;
  EXPECT_NEAR(check_surface(result).volume, expected, 0.02 * check_surface(surface).area);
}

TEST(Decimate, FewerTrianglesForALooserTolerance) {
  const TriMesh surface = sphere();
  std::int64_t last = static_cast<std::int64_t>(surface.triangles.size());
  for (const double tolerance : {0.003, 0.01, 0.03, 0.1}) {
    const std::int64_t now = expect_decimated(surface, tolerance).triangles_after;
    EXPECT_LT(now, last) << tolerance;
    last = now;
  }
}

TEST(Decimate, ATorusKeepsItsHole) {
  for (const double tolerance : {0.01, 0.05, 0.3, 1.0}) expect_decimated(torus(), tolerance);
}

TEST(Decimate, AFlatBoxNeedsTwelveTriangles) {
  for (const Index n : {3, 5, 9, 12, 16}) {
    const TriMesh surface = level_set(kBox, {n, 9, 20 - n}, [](const Vec3&) { return 1.0; });
    EXPECT_EQ(expect_decimated(surface, 1e-6).triangles_after, 12) << n;
    TriMesh tilted = surface;  // where errors are round-off instead of zero
    for (Vec3& p : tilted.points) {
      p = {0.36 * p.x + 0.48 * p.y - 0.8 * p.z + 17, -0.8 * p.x + 0.6 * p.y,
           0.48 * p.x + 0.64 * p.y + 0.6 * p.z - 5};
    }
    EXPECT_EQ(expect_decimated(tilted, 1e-6).triangles_after, 12) << n << " tilted";
  }
}

TEST(Decimate, FlatSidesGoBeforeCorners) {
  for (const Index n : {3, 4, 5, 7, 12}) {
    const TriMesh surface = level_set(kBox, {n, n, n}, [](const Vec3&) { return 1.0; });
    DecimateReport report;
    decimate(surface, {.triangles = 40}, &report);
    EXPECT_NEAR(static_cast<double>(report.triangles_after), 40, 1) << n;
    EXPECT_LT(report.original_to_result, 1e-5) << n;
    EXPECT_LT(report.result_to_original, 1e-5) << n;
  }
}

TEST(Decimate, ThinPlatesDoNotMerge) {
  // Two layers 0.2 apart, bent and rough; the tolerance would let them pass through each other.
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-0.03, 0.03);
  const Box box{{0, 0, -1}, {12, 12, 3}};
  const TriMesh surface = level_set(box, {24, 24, 40}, [&](const Vec3& p) {
    return 0.1 - std::abs(p.z - 1 - 0.4 * std::sin(p.x / 2)) + uniform(generator);
  });
  ASSERT_TRUE(find_self_intersections(surface).empty());
  const DecimateReport report = expect_decimated(surface, 0.3);
  EXPECT_LT(report.triangles_after, report.triangles_before / 3);
}

TEST(Decimate, ACrackStaysOpen) {
  // A block with a slit 0.1 wide and 1.5 deep, one node of the mesh across.
  const Box box{{0, 0, 0}, {4, 2, 4}};
  const TriMesh surface = level_set(box, {41, 4, 16}, [](const Vec3& p) {
    const bool in_block = p.z < 2.9;
    const bool in_slit = std::abs(p.x - 2.01) < 0.06 && p.z > 1.4;
    return in_block && !in_slit ? 1.0 : -1.0;
  });
  expect_decimated(surface, 0.2);
  expect_decimated(surface, 0.05);
}

TEST(Decimate, ANeedleIsNotCutOff) {
  // A cone 2 long on a ball; quadrics find its tip cheap, for its triangles are small.
  const Box box{{-1, -1, -1}, {1, 1, 3}};
  const TriMesh surface = level_set(box, {24, 24, 48}, [](const Vec3& p) {
    const double ball = 0.6 - norm(p);
    const double cone = 0.12 * (2.6 - p.z) / 2 - std::hypot(p.x - 0.01, p.y - 0.02);
    return std::max(ball, p.z > 0 ? cone : -1.0);
  });
  auto height = [](const TriMesh& s) {
    double top = -10;
    for (const Vec3& p : s.points) top = std::max(top, p.z);
    return top;
  };
  for (const double tolerance : {0.02, 0.1}) {
    const TriMesh result = decimate(surface, {.tolerance = tolerance});
    EXPECT_GE(height(result), height(surface) - tolerance);
    expect_decimated(surface, tolerance);
  }
}

TEST(Decimate, NoiseOfAllScales) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const TriMesh surface =
        level_set(kBox, {9, 9, 9}, [&](const Vec3&) { return uniform(generator) - 0.2; });
    const double pitch = 2.0 / 9;
    expect_decimated(surface, 0.1 * pitch);
    expect_decimated(surface, pitch);
  }
}

TEST(Decimate, IsTheSameFarFromTheOrigin) {
  // Turned, no triangle lies across an axis; there single precision resolves the tolerance well.
  TriMesh turned = level_set(kBox, {30, 30, 30}, [](const Vec3& p) {
    return 0.7 - norm(p - Vec3{0.1, 0.05, 0});
  });
  for (Vec3& p : turned.points) {
    p = {0.8 * p.x - 0.6 * p.y, 0.48 * p.x + 0.64 * p.y - 0.6 * p.z,
         0.36 * p.x + 0.48 * p.y + 0.8 * p.z};
  }
  const auto near = decimate(turned, {.tolerance = 0.002}).triangles.size();
  for (const double way : {10.0, 100.0, 1e3}) {
    TriMesh moved = turned;
    for (Vec3& p : moved.points) p += {way, -way, way};
    const auto far = decimate(moved, {.tolerance = 0.002}).triangles.size();
    EXPECT_NEAR(static_cast<double>(far), static_cast<double>(near),
                0.05 * static_cast<double>(near));
  }
}

TEST(Decimate, PutsPointsWhereSinglePrecisionHoldsThem) {
  TriMesh surface = sphere();
  for (Vec3& p : surface.points) p = rounded(p);
  for (const Vec3& p : decimate(surface, {.tolerance = 0.05}).points) EXPECT_EQ(p, rounded(p));
}

TEST(Decimate, KeepsTheBoxThatCutsAnObject) {
  const TriMesh surface = level_set(kBox, {14, 14, 14}, [](const Vec3& p) {
    return 1.2 - norm(p - Vec3{0.1, 0.2, 0.3});
  });
  const TriMesh result = decimate(surface, {.tolerance = 0.02});
  const auto area_in_box = [](const TriMesh& s) {
    double area = 0;
    for (const Triangle& t : s.triangles) {
      const Corners c = corners_of(s, t);
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(c[0][axis]) == 1 && c[0][axis] == c[1][axis] && c[0][axis] == c[2][axis]) {
          area += norm(cross(c[1] - c[0], c[2] - c[0])) / 2;
        }
      }
    }
    return area;
  };
  EXPECT_GT(area_in_box(surface), 1);
  EXPECT_NEAR(area_in_box(result), area_in_box(surface), 0.05 * area_in_box(surface));
  for (const Vec3& p : result.points) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LE(p[axis], 1) << "the ball reaches over these sides";
  }
}

/// The cosine of the angle between the normals of neighbours, where that is the least.
double sharpest_edge(const TriMesh& surface) {
  std::map<std::pair<Index, Index>, Vec3> normals;
  for (const Triangle& t : surface.triangles) {
    const Vec3& p = surface.points[t[0]];
    const Vec3 normal = unit_or_zero(cross(surface.points[t[1]] - p, surface.points[t[2]] - p));
    for (std::size_t i = 0; i < 3; ++i) normals[{t[i], t[(i + 1) % 3]}] = normal;
  }
  double least = 1;
  for (const auto& [edge, normal] : normals) {
    const auto other = normals.find({edge.second, edge.first});
    if (other != normals.end()) least = std::min(least, dot(normal, other->second));
  }
  return least;
}

TEST(Decimate, MakesNoCreases) {
  const TriMesh smooth = ball_surface(1, 40);
  const double allowed = std::cos(25.01 * std::numbers::pi / 180);
  ASSERT_GT(sharpest_edge(smooth), allowed) << "not smooth itself";
  const TriMesh result = decimate(smooth, {.tolerance = 0.05});
  EXPECT_LT(result.triangles.size(), smooth.triangles.size() / 4);
  EXPECT_GE(sharpest_edge(result), allowed);
  const TriMesh rough = torus(30);  // with the creases of its grid
  EXPECT_LE(edge_lengths(decimate(rough, {.tolerance = 0.05})).creases,
            1.1 * edge_lengths(rough).creases);
}

TEST(Decimate, ReachesANumberOfTriangles) {
  const TriMesh surface = sphere();
  for (const std::int64_t triangles : {1000, 300, 100, 20}) {
    DecimateReport report;
    const TriMesh result = decimate(surface, {.triangles = triangles}, &report);
    expect_promises_kept(surface, result, report, 1.0);
    EXPECT_NEAR(static_cast<double>(report.triangles_after), static_cast<double>(triangles),
                0.02 * static_cast<double>(triangles) + 1);
  }
}

TEST(Decimate, HasTheSameBytesForAnyNumberOfThreads) {
  const TriMesh surface = torus();
  const TriMesh one = with_threads(1, [&] { return decimate(surface, {.tolerance = 0.01}); });
  const TriMesh three = with_threads(3, [&] { return decimate(surface, {.tolerance = 0.01}); });
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.triangles, three.triangles);
}

TEST(Decimate, LeavesASurfaceAloneForNoTolerance) {
  const TriMesh surface = sphere();
  DecimateReport report;
  const TriMesh result = decimate(surface, {.tolerance = 0}, &report);
  EXPECT_EQ(result.points, surface.points);
  EXPECT_EQ(result.triangles, surface.triangles);
  EXPECT_EQ(report.triangles_after, report.triangles_before);
}

TEST(Decimate, StopsWhenTold) {
  const Progress stop = [](std::string_view, double) { return false; };
  EXPECT_THROW(decimate(sphere(), {.tolerance = 0.01, .progress = stop}), Cancelled);
}

TEST(Decimate, RefusesWhatIsNoClosedManifold) {
  using ::testing::HasSubstr;
  TriMesh open = cube();
  open.triangles.pop_back();
  EXPECT_REFUSED(decimate(open, {.tolerance = 1}), HasSubstr("3 open edges"));
  TriMesh doubled = cube();
  doubled.triangles.push_back(doubled.triangles[0]);
  EXPECT_REFUSED(decimate(doubled, {.tolerance = 1}), HasSubstr("non-manifold"));
  TriMesh degenerate = cube();
  degenerate.triangles.push_back({1, 1, 2});
  EXPECT_REFUSED(decimate(degenerate, {.tolerance = 1}), HasSubstr("degenerate"));
  EXPECT_REFUSED(decimate({}, {.tolerance = 1}), HasSubstr("no triangle"));
  EXPECT_REFUSED(decimate(cube(), {.tolerance = -1}), HasSubstr("tolerance"));
  EXPECT_REFUSED(decimate(cube(), {.tolerance = std::nan("")}), HasSubstr("tolerance"));
  EXPECT_REFUSED(decimate(cube(), {.triangles = -1}), HasSubstr("triangles"));
}

}  // namespace
}  // namespace mesamis
