// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/decimate/collapse.h"
#include "mesamis/decimate/decimation.h"
#include "mesamis/decimate/round_together.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/extract_net.h"
#include "mesamis/surface/half_edges.h"
#include "support/label_grids.h"
#include "support/level_set.h"
#include "support/partition_laws.h"
#include "support/random_memberships.h"
#include "support/solids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

PartitionSurface blobs(Index n = 14, int count = 4) {
  const OwnedLabels labels = random_blobs(n, count, 4);
  return extract_partition_on_grid(smooth_memberships(labels.grid()));
}

/// Wavy layers, thinner than the tolerances below.
PartitionSurface layers() {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {16, 16, 16});
  std::vector<std::vector<double>> fields(5);
  for (const Vec3& p : mesh.points) {
    const double height = p.z - 0.5 - 0.1 * std::sin(9 * p.x) * std::cos(8 * p.y);
    // The upper envelope of lines: layer m between heights 0.07 (m - 2) and 0.07 (m - 1).
    for (int m = 0; m < 5; ++m) {
      fields[static_cast<std::size_t>(m)].push_back(m * height - 0.07 * 0.5 * m * (m - 3));
    }
  }
  return extract_partition(mesh, fields);
}

/// The edges of other than two triangles: of each point on one the points that it shares one with.
using Curves = std::map<std::array<double, 3>, std::set<std::array<double, 3>>>;

Curves curves_of(const PartitionSurface& partition) {
  Curves curves;
  const auto at = [&](Index p) {
    const Vec3& x = partition.points[p];
    return std::array{x.x, x.y, x.z};
  };
  const auto half_edges = sorted_half_edges(partition.triangles, partition.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() == 2) return;
    curves[at(edge[0].lo)].insert(at(edge[0].hi));
    curves[at(edge[0].hi)].insert(at(edge[0].lo));
  });
  return curves;
}

/// The edges of one triangle.
std::set<std::array<double, 6>> rims_of(const PartitionSurface& partition) {
  std::set<std::array<double, 6>> rims;
  const auto half_edges = sorted_half_edges(partition.triangles, partition.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 1) return;
    const Vec3 &a = partition.points[edge[0].lo], &b = partition.points[edge[0].hi];
    const bool turned = std::array{b.x, b.y, b.z} < std::array{a.x, a.y, a.z};
    const Vec3 &first = turned ? b : a, &last = turned ? a : b;
    rims.insert({first.x, first.y, first.z, last.x, last.y, last.z});
  });
  return rims;
}

/// Whether what closes the objects at the box is on it.
bool has_caps_on_box(const PartitionSurface& partition, const Box& box) {
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    if (partition.sides[t][1] != kNoIndex) continue;
    bool on_box = false;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {box.lo[axis], box.hi[axis]}) {
        on_box |= std::ranges::all_of(partition.triangles[t],
                                      [&](Index p) { return partition.points[p][axis] == side; });
      }
    }
    if (!on_box) return false;
  }
  return true;
}

/// What stays of curves: where other than two of their edges meet, and in how many.
std::map<std::array<double, 3>, std::size_t> ends_of(const Curves& curves) {
  std::map<std::array<double, 3>, std::size_t> ends;
  for (const auto& [point, neighbors] : curves) {
    if (neighbors.size() != 2) ends[point] = neighbors.size();
  }
  return ends;
}

/// The number of curves that are connected, and of points less that of edges.
std::array<std::int64_t, 2> topology_of(const Curves& curves) {
  std::map<std::array<double, 3>, std::size_t> number;
  for (const auto& [point, neighbors] : curves) number.emplace(point, number.size());
  DisjointSets sets(number.size());
  std::int64_t ends = 0;
  for (const auto& [point, neighbors] : curves) {
    ends += std::ssize(neighbors);
    for (const auto& neighbor : neighbors) sets.unite(number[point], number[neighbor]);
  }
  return {sets.numbers().count, std::ssize(curves) - ends / 2};
}

/// The boundaries between each pair of materials.
std::map<std::array<Index, 2>, TriMesh> boundaries_of(const PartitionSurface& partition) {
  std::map<std::array<Index, 2>, TriMesh> boundaries;
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    TriMesh& own = boundaries[partition.sides[t]];
    const auto first = static_cast<Index>(own.points.size());
    for (const Index p : partition.triangles[t]) own.points.push_back(partition.points[p]);
    own.triangles.push_back({first, first + 1, first + 2});
  }
  return boundaries;
}

/// Of all that is not outside.
double volume_within_caps(const PartitionSurface& partition) {
  double six = 0;
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    if (partition.sides[t][1] != kNoIndex) continue;
    const auto [a, b, c] = partition.triangles[t];
    six += dot(partition.points[a], cross(partition.points[b], partition.points[c]));
  }
  return six / 6;
}

std::int64_t euler(const TriMesh& s) { return std::ssize(s.points) - std::ssize(s.triangles) / 2; }

/// Everything that decimate_partition() promises, looked at from outside.
void expect_promises_kept(const PartitionSurface& before, const PartitionSurface& after,
                          double tolerance, bool closed = true) {
  ASSERT_EQ(after.sides.size(), after.triangles.size());
  EXPECT_EQ(materials_of(after), materials_of(before));
  double volume = 0;
  for (const Index m : materials_of(before)) {
    const TriMesh old = object_surface(before, m), now = object_surface(after, m);
    const SurfaceCheck old_check = check_surface(old), now_check = check_surface(now);
    EXPECT_TRUE(now_check.manifold()) << m << " " << flaws_of(now_check);
    EXPECT_EQ(now_check.open_edges, old_check.open_edges) << m;
    EXPECT_EQ(now_check.components, old_check.components) << m;
    if (closed) {
      EXPECT_EQ(euler(now), euler(old)) << m;
    }
    volume += now_check.volume;
  }
  if (closed) {
    const double whole = volume_within_caps(after);  // without gaps and overlaps
    EXPECT_NEAR(volume, whole, 1e-10 * whole + 1e-12);
  }
  EXPECT_TRUE(find_self_intersections({after.points, after.triangles}).empty());
  const Curves curves = curves_of(before), curves_now = curves_of(after);
  EXPECT_EQ(ends_of(curves_now), ends_of(curves));
  EXPECT_EQ(topology_of(curves_now), topology_of(curves));
  EXPECT_LE(curves_now.size(), curves.size());
  EXPECT_EQ(rims_of(after), rims_of(before));
  if (std::isinf(tolerance)) return;
  EXPECT_NEAR(volume_within_caps(after), volume_within_caps(before),
              1e-9 * volume_within_caps(before));
  EXPECT_TRUE(has_caps_on_box(after, bounding_box(before.points)));
  const auto old = boundaries_of(before), now = boundaries_of(after);
  ASSERT_EQ(now.size(), old.size());
  for (const auto& [sides, surface] : old) {
    const TriMesh& other = now.at(sides);
    EXPECT_LE(max_distance(surface, other, 1e-3 * tolerance), 1.005 * tolerance);
    EXPECT_LE(max_distance(other, surface, 1e-3 * tolerance), 1.005 * tolerance);
  }
}

TEST(DecimatePartition, KeepsItsPromisesForBlobs) {
  const PartitionSurface partition = blobs();
  std::size_t last = partition.triangles.size();
  for (const double tolerance : {0.05, 0.2, 1.0}) {
    DecimateReport report;
    const auto result = decimate_partition(partition, {.tolerance = tolerance}, &report);
    expect_promises_kept(partition, result, tolerance);
    EXPECT_LT(result.triangles.size(), last);
    last = result.triangles.size();
    EXPECT_EQ(report.triangles_before, std::ssize(partition.triangles));
    EXPECT_EQ(report.triangles_after, std::ssize(result.triangles));
    EXPECT_LE(report.original_to_result, tolerance);
    EXPECT_LE(report.result_to_original, tolerance);
  }
  EXPECT_LT(last, partition.triangles.size() / 3);
}

TEST(DecimatePartition, KeepsLayersApartThatAreThinnerThanTheTolerance) {
  const PartitionSurface partition = layers();
  expect_partition_laws(partition, 1, "layers");
  for (const double tolerance : {0.1, 0.5, std::numeric_limits<double>::infinity()}) {
    const auto result = decimate_partition(partition, {.tolerance = tolerance});
    expect_promises_kept(partition, result, tolerance);
    EXPECT_LT(result.triangles.size(), partition.triangles.size() * 2 / 3);
  }
}

/// Labels without any order, which meet everywhere and reach the box.
PartitionSurface noise(unsigned seed, unsigned count, const PartitionOptions& options = {},
                       Index n = 9, double sigma_voxel = 1.5) {
  std::mt19937 generator(seed);
  OwnedLabels labels{.size = {n, n, n}};
  for (Index p = 0; p < n * n * n; ++p) {
    labels.labels.push_back(static_cast<std::uint16_t>(generator() % count));
  }
  return extract_partition_on_grid(smooth_memberships(labels.grid(), {.sigma_voxel = sigma_voxel}),
                                   options);
}

TEST(DecimatePartition, KeepsItsPromisesForNoise) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto partition = noise(seed, seed + 1);
    for (const double tolerance : {0.1, 5.0}) {
      const auto result = decimate_partition(partition, {.tolerance = tolerance});
      expect_promises_kept(partition, result, tolerance);
    }
  }
}

/// Beyond a point at which an interface touches itself a collapse could make the same edge again.
TEST(DecimatePartition, MakesNoEdgeTwiceWhereAnInterfaceTouchesItself) {
  for (const unsigned seed : {38, 39, 40}) {
    PartitionSurface net = extract_net_on_grid(random_grid({6, 5, 6}, 5, seed));
    net.points = round_together(net.points);
    for (const double tolerance : {0.15, 0.4}) {
      const PartitionSurface few = decimate_partition(net, {.tolerance = tolerance});
      EXPECT_LT(few.triangles.size(), net.triangles.size());
      for (const Index m : materials_of(net)) {
        const SurfaceCheck was = check_surface(object_surface(net, m));
        const SurfaceCheck is = check_surface(object_surface(few, m));
        EXPECT_EQ(is.nonmanifold_edges, was.nonmanifold_edges) << seed << " " << m;
        EXPECT_EQ(is.components, was.components) << seed << " " << m;
      }
    }
  }
}

TEST(DecimatePartition, ReportsBoundsWithinTheTolerance) {
  const PartitionSurface partition = blobs();
  DecimateReport report;
  const auto result = decimate_partition(partition, {.tolerance = 0.3}, &report);
  expect_promises_kept(partition, result, 0.3);
  EXPECT_LE(report.original_to_result, 0.3);
  EXPECT_LE(report.result_to_original, 0.3);
  EXPECT_GT(std::min(report.original_to_result, report.result_to_original), 0.1);
  EXPECT_LT(result.triangles.size(), partition.triangles.size() / 2);
}

TEST(DecimatePartition, StopsAtTheTrianglesAskedFor) {
  const PartitionSurface partition = blobs();
  const auto all = std::ssize(partition.triangles);
  for (std::int64_t most = all * 3 / 4; most > all / 2; most -= 331) {
    const auto result = decimate_partition(partition, {.triangles = most});
    EXPECT_LE(std::ssize(result.triangles), most);
    EXPECT_GE(std::ssize(result.triangles), most - 2);
    if (most > all * 3 / 4 - 331) {
      expect_promises_kept(partition, result, std::numeric_limits<double>::infinity());
    }
  }
}

/// A box of two slabs: straight curves around it.
TEST(DecimatePartition, LeavesOnlyTheEndsOfStraightCurves) {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {6, 6, 6});
  std::vector<std::vector<double>> fields(2);
  for (const Vec3& p : mesh.points) {
    fields[0].push_back(0.45 - p.z);
    fields[1].push_back(0);
  }
  const auto result = decimate_partition(extract_partition(mesh, fields), {.tolerance = 0.01});
  const Curves curves = curves_of(result);
  EXPECT_EQ(curves.size(), 4u);
  for (const auto& [point, neighbors] : curves) {
    for (const std::size_t axis : {0u, 1u}) {
      EXPECT_EQ(std::min(point[axis], 1 - point[axis]), 0);
    }
    EXPECT_NEAR(point[2], 0.45, 1e-6);
  }
  EXPECT_EQ(result.triangles.size(), 2u + 2 * 2 + 2 * 4 * 2);
}

/// Two balls with a common disc: a circle is the curve.
TEST(DecimatePartition, KeepsARoundCurveWithinTheTolerance) {
  const TetMesh mesh = box_mesh({{-1, -1, -1}, {1, 1, 1}}, {20, 20, 20});
  std::vector<std::vector<double>> fields(3);
  for (const Vec3& p : mesh.points) {
    fields[0].push_back(0);
    fields[1].push_back(0.55 - norm(p - Vec3{-0.3, 0.01, 0.02}));
    fields[2].push_back(0.55 - norm(p - Vec3{0.3, 0.01, 0.02}));
  }
  const PartitionSurface partition = extract_partition(mesh, fields);
  const double radius = std::sqrt(0.55 * 0.55 - 0.3 * 0.3), tolerance = 0.02;
  const auto result = decimate_partition(partition, {.tolerance = tolerance});
  const auto farthest_from_circle = [radius](const Curves& curves) {
    double farthest = 0;
    for (const auto& [from, neighbors] : curves) {
      for (const auto& to : neighbors) {
        const double x = 0.5 * (from[0] + to[0]), y = 0.5 * (from[1] + to[1]) - 0.01,
                     z = 0.5 * (from[2] + to[2]) - 0.02;
        farthest = std::max(farthest, std::hypot(x, std::hypot(y, z) - radius));
      }
    }
    return farthest;
  };
  const Curves before = curves_of(partition), after = curves_of(result);
  EXPECT_LT(after.size(), before.size() / 2);
  EXPECT_LT(farthest_from_circle(after), farthest_from_circle(before) + tolerance);
}

TEST(DecimatePartition, LeavesTheRimsOfAnOpenOne) {
  const PartitionSurface partition = noise(3, 4, {.close_at_box = false});
  ASSERT_GT(rims_of(partition).size(), 100u);
  const auto result = decimate_partition(partition, {.tolerance = 0.3});
  EXPECT_LT(result.triangles.size(), partition.triangles.size());
  expect_promises_kept(partition, result, 0.3, false);
}

/// A wavy ball of two halves: from outside it is smooth across the curve between them.
/// @param wave    height of the waves.
/// @param across  normal of the plane that divides it.
/// @param at      three times the plane's place along that.
PartitionSurface ball_of_halves(double wave, const Vec3& across, double at) {
  const TriMesh ball = level_set({{-1, -1, -1}, {1, 1, 1}}, {20, 20, 20}, [wave](const Vec3& p) {
    return 0.8 + wave * std::sin(9 * p.x) * std::sin(8 * p.z) - norm(p - Vec3{0.013, 0.021, 0.007});
  });
  PartitionSurface halves{ball.points, {}, {}};
  const auto center = static_cast<Index>(halves.points.size());
  halves.points.push_back({0, 0, 0});
  const auto half_of = [&](Index t) {
    const auto [a, b, c] = corners_of(ball, ball.triangles[t]);
    return dot(across, a + b + c) < at ? 1 : 2;
  };
  for (Index t = 0; t < std::ssize(ball.triangles); ++t) {
    const auto [a, b, c] = ball.triangles[t];
    halves.triangles.push_back({a, c, b});  // as seen from inside
    halves.sides.push_back({0, half_of(t)});
  }
  const auto half_edges = sorted_half_edges(ball.triangles, ball.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (half_of(edge[0].triangle) == half_of(edge[1].triangle)) return;
    const HalfEdge& own = half_of(edge[0].triangle) == 1 ? edge[0] : edge[1];
    const Triangle& k = ball.triangles[own.triangle];
    halves.triangles.push_back({k[(own.corner + 1) % 3], k[own.corner], center});
    halves.sides.push_back({1, 2});
  });
  return halves;
}

/// The creases that one sees from outside: crease_at() at all edges, and at those of curves.
std::array<double, 2> creases_outside(const PartitionSurface& partition) {
  const TriMesh outside = object_surface(partition, 0);
  const Curves curves = curves_of(partition);
  std::array<double, 2> sums{};
  const auto half_edges = sorted_half_edges(outside.triangles, outside.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    const Vec3 &a = outside.points[edge[0].lo], &b = outside.points[edge[0].hi];
    const auto normal = [&](const HalfEdge& half) {
      return unit_normal(corners_of(outside, outside.triangles[half.triangle]));
    };
    const double crease = crease_at(a, b, normal(edge[0]), normal(edge[1]));
    const auto found = curves.find({a.x, a.y, a.z});
    const bool at_curve = found != curves.end() && found->second.count({b.x, b.y, b.z}) > 0;
    sums[0] += crease;
    sums[1] += at_curve ? crease : 0;
  });
  return sums;
}

TEST(DecimatePartition, MakesNoCreaseWhereObjectsGoOnSmoothly) {
  const PartitionSurface partition = ball_of_halves(0.02, {0.3, 1, 0.2}, 0.1);
  const double before = creases_outside(partition)[0];
  for (const double tolerance : {0.02, 0.05, 0.1}) {
    const auto result = decimate_partition(partition, {.tolerance = tolerance});
    expect_promises_kept(partition, result, tolerance);
    EXPECT_LT(curves_of(result).size(), curves_of(partition).size());
    EXPECT_LE(creases_outside(result)[0], before) << tolerance;
  }
}

/// Neither where edges of a curve go, nor where triangles beside it change, whatever the tolerance
/// would allow.
TEST(DecimatePartition, MakesNoCreaseOfACurveWhereObjectsGoOnSmoothly) {
  struct Case {
    Vec3 across;
    double at, tolerance;
  };
  for (const Case& c : {Case{{0.3, 1, 0.2}, 0.1, 0.05}, Case{{0.7, 0.5, 0.2}, 0.3, 0.2}}) {
    for (const double wave : {0.0, 0.01}) {
      const PartitionSurface partition = ball_of_halves(wave, c.across, c.at);
      ASSERT_EQ(creases_outside(partition)[1], 0);
      const auto result = decimate_partition(partition, {.tolerance = c.tolerance});
      EXPECT_LT(curves_of(result).size(), curves_of(partition).size() * 2 / 3);
      EXPECT_LT(creases_outside(result)[1], 1e-6) << "rounding alone";
    }
  }
}

/// A flat lens on a floor: at their curve, the unit circle, all boundaries are nearly in one plane.
/// @param slope  of the lens at the circle.
PartitionSurface lens_on_floor(double slope, Index turns) {
  constexpr int kRings = 8;
  std::vector<ProfilePoint> profile;  // the floor beyond the lens, and the lens from above
  for (int i = 0; i < kRings; ++i) profile.push_back({2.0 - 1.0 * i / kRings, 0});
  for (int i = 0; i <= kRings; ++i) {
    const double radius = 1 - 1.0 * i / kRings;
    profile.push_back({radius, 0.5 * slope * (1 - radius * radius)});
  }
  TriMesh seen = revolved(profile, turns);
  PartitionSurface lens;
  for (const Triangle& t : seen.triangles) {
    lens.triangles.push_back({t[0], t[2], t[1]});  // as seen from below
    const double z = seen.points[t[0]].z + seen.points[t[1]].z + seen.points[t[2]].z;
    lens.sides.push_back({0, z > 0 ? 2 : 1});
  }
  lens.points = std::move(seen.points);
  const auto center = static_cast<Index>(lens.points.size());
  lens.points.push_back({0, 0, 0});
  for (Index k = 0; k < turns; ++k) {
    const Index ring = kRings * turns;
    lens.triangles.push_back({ring + k, ring + (k + 1) % turns, center});
    lens.sides.push_back({1, 2});
  }
  return lens;
}

/// The boundaries hardly say where the curve goes: it holds itself. With its points at the best
/// places its edges lie nearer to the circle than those of a polygon with points on it, whose mean
/// distance is two thirds of the greatest.
TEST(DecimatePartition, KeepsACurveInPlaceWhereBoundariesAreNearlyInOnePlane) {
  for (const double slope : {0.02, 0.05}) {
    const PartitionSurface partition = lens_on_floor(slope, 48);
    for (const double tolerance : {0.01, 0.02, 0.03, 0.05}) {
      const auto result = decimate_partition(partition, {.tolerance = tolerance});
      double away = 0, length = 0, points = 0;
      for (const auto& [from, neighbors] : curves_of(result)) {
        const Vec3 a{from[0], from[1], from[2]};
        if (norm(a) > 1.5) continue;  // the end of the floor
        points += 1;
        for (const auto& to : neighbors) {
          const Vec3 way = Vec3{to[0], to[1], to[2]} - a;
          constexpr int kSteps = 20;
          for (int i = 0; i < kSteps; ++i) {
            away += std::abs(norm(a + ((i + 0.5) / kSteps) * way) - 1) * norm(way) / kSteps;
          }
          length += norm(way);
        }
      }
      EXPECT_LT(points, 48 * 2 / 3);
      EXPECT_LT(away / length, 2.0 / 3 * (1 - std::cos(std::numbers::pi / points)));
    }
  }
}

TEST(DecimatePartition, HasTheSameBytesForAnyNumberOfThreads) {
  const PartitionSurface partition = blobs();
  const DecimateOptions options{.tolerance = 0.2};
  const auto one = with_threads(1, [&] { return decimate_partition(partition, options); });
  const auto two = with_threads(2, [&] { return decimate_partition(partition, options); });
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.triangles, two.triangles);
  EXPECT_EQ(one.sides, two.sides);
}

/// Through patches, as large partitions are decimated.
PartitionSurface decimated_in_patches(const PartitionSurface& partition, double tolerance,
                                      double triangles_per_patch) {
  const Interfaces interfaces = cut_into_interfaces(partition);
  PatchworkReport work;
  const TriMesh result =
      decimate_interfaces(interfaces, {.tolerance = tolerance}, triangles_per_patch, work);
  PartitionSurface joined{partition.points, {}, {}};
  std::map<Index, std::array<Index, 2>> sides;
  for (std::size_t t = 0; t < partition.sides.size(); ++t) {
    sides[interfaces.of_point[interfaces.surface.triangles[t][0]]] = partition.sides[t];
  }
  for (const Triangle& t : result.triangles) {
    for (const Index p : t) joined.points[interfaces.origin[p]] = result.points[p];
    joined.triangles.push_back(
        {interfaces.origin[t[0]], interfaces.origin[t[1]], interfaces.origin[t[2]]});
    joined.sides.push_back(sides[interfaces.of_point[t[0]]]);
  }
  return joined;
}

TEST(DecimatePartition, KeepsItsPromisesPatchByPatch) {
  for (const PartitionSurface& partition : {blobs(), layers()}) {
    const PartitionSurface result = decimated_in_patches(partition, 0.1, 1500);
    expect_promises_kept(partition, result, 0.1);
    EXPECT_LT(result.triangles.size(), partition.triangles.size());
  }
}

/// With seed 38 triangles of two patches meet of which no corner has gone: one has moved.
TEST(DecimatePartition, KeepsItsPromisesInManySmallPatches) {
  for (const unsigned seed : {2U, 38U}) {
    const PartitionSurface partition = noise(seed, 4, {.close_at_box = false}, 10, 1.0);
    const PartitionSurface result = decimated_in_patches(partition, 0.2, 300);
    expect_promises_kept(partition, result, 0.2, false);
    EXPECT_LT(result.triangles.size(), 0.8 * static_cast<double>(partition.triangles.size()));
  }
}

TEST(DecimatePartition, LeavesAllWithoutATolerance) {
  const PartitionSurface partition = blobs(12, 3);
  const auto result = decimate_partition(partition, {.tolerance = 0});
  EXPECT_EQ(result.triangles, partition.triangles);
  EXPECT_TRUE(decimate_partition({}, {.tolerance = 1}).triangles.empty());
}

TEST(DecimatePartition, RefusesBadOptionsAndSurfaces) {
  PartitionSurface partition = blobs(12, 3);
  EXPECT_REFUSED(decimate_partition(partition, {.tolerance = -1}), testing::HasSubstr("tolerance"));
  EXPECT_REFUSED(decimate_partition(partition, {.triangles = -1}), testing::HasSubstr("triangles"));
  partition.sides.pop_back();
  EXPECT_REFUSED(decimate_partition(partition, {.tolerance = 1}), testing::HasSubstr("sides"));
}

}  // namespace
}  // namespace mesamis
