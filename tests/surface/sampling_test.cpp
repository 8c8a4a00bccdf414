// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/surface/distance.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

TEST(SampleByArea, GivesEachTriangleItsShare) {
  const TriMesh surface = random_triangles(200, {1, 1, 1});
  const std::size_t count = 10'000;
  const std::vector<Vec3> samples = sample_by_area(surface, count);
  ASSERT_EQ(samples.size(), count);
  const double total = check_surface(surface).area;
  for (std::size_t t = 0, next = 0; t < surface.triangles.size(); ++t) {
    TriMesh one{surface.points, {surface.triangles[t]}};
    const double share = check_surface(one).area / total * static_cast<double>(count);
    const std::vector<double> away = distances_to_surface(samples, one);
    std::size_t found = 0;
    while (next < count && away[next] < 1e-12) ++next, ++found;
    EXPECT_NEAR(static_cast<double>(found), share, 1.0001) << t;
  }
}

TEST(SampleByArea, FillsATriangleEvenly) {
  // Halved along each of its three medians, both halves hold as many samples.
  const TriMesh surface{{{0, 0, 0}, {3, 0, 0}, {1, 2, 5}}, {{0, 1, 2}}};
  const std::vector<Vec3> samples = sample_by_area(surface, 1000);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& a = surface.points[i];
    const Vec3& b = surface.points[(i + 1) % 3];
    const Vec3& c = surface.points[(i + 2) % 3];
    const Vec3 normal = cross(b - a, c - a), across = cross(normal, 0.5 * (b + c) - a);
    const auto right = std::count_if(samples.begin(), samples.end(),
                                     [&](const Vec3& p) { return dot(p - a, across) > 0; });
    EXPECT_NEAR(static_cast<double>(right), 500, 20);
  }
}

TEST(SampleByArea, IntegratesALinearFunction) {
  const std::vector<Vec3> samples = sample_by_area(cube(), 600);
  Vec3 mean;
  for (const Vec3& p : samples) mean += (1.0 / 600) * p;
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(mean[axis], 0.5, 0.01);
}

TEST(SampleByArea, IsTheSameTwice) {
  const TriMesh surface = random_triangles(50, {1, 1, 1});
  EXPECT_EQ(sample_by_area(surface, 333), sample_by_area(surface, 333));
}

TEST(SampleByArea, SkipsTrianglesWithoutArea) {
  TriMesh surface = cube();
  surface.points.push_back({100, 100, 100});
  surface.triangles.insert(surface.triangles.begin(), {8, 8, 0});
  surface.triangles.push_back({8, 8, 8});
  for (const Vec3& p : sample_by_area(surface, 100)) EXPECT_LE(p.x, 1);
}

TEST(SampleByArea, OfNoAreaIsRefused) {
  EXPECT_TRUE(sample_by_area({}, 0).empty());
  EXPECT_THROW(sample_by_area({}, 1), InputError);
  EXPECT_THROW(sample_by_area({{{1, 2, 3}}, {{0, 0, 0}}}, 1), InputError);
}

TEST(SampleTrianglesByArea, GivesEachTriangleItsShare) {
  const TriMesh surface = random_triangles(200, {1, 1, 1});
  const double share = check_surface(surface).area / 200;
  const auto samples = sample_triangles_by_area(surface);
  EXPECT_NEAR(static_cast<double>(samples.size()), 200, 1);
  for (const Triangle& t : surface.triangles) {
    const TriMesh one{surface.points, {t}};
    const Vec3 normal = cross(surface.points[t[1]] - surface.points[t[0]],
                              surface.points[t[2]] - surface.points[t[0]]);
    const Vec3 centroid =
        (1.0 / 3) * (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]);
    const auto found = std::count_if(samples.begin(), samples.end(), [&](const TriangleSample& s) {
      return norm(s.position - centroid) < 1e-12 &&
             dot(s.normal, normal) > (1 - 1e-12) * norm(normal);
    });
    EXPECT_NEAR(static_cast<double>(found), check_surface(one).area / share, 1.0001);
  }
}

TEST(SampleTrianglesByArea, ScalesPositionsAndNotNormals) {
  const auto plain = sample_triangles_by_area(cube()), scaled = sample_triangles_by_area(cube(), 4);
  ASSERT_EQ(plain.size(), 12u);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR(norm(scaled[i].position - 4 * plain[i].position), 0, 1e-14);
    EXPECT_EQ(scaled[i].normal, plain[i].normal);
    EXPECT_GT(dot(plain[i].normal, plain[i].position - Vec3{0.5, 0.5, 0.5}), 0.49);
  }
}

TEST(SampleTrianglesByArea, OfNoAreaIsRefused) {
  EXPECT_THROW(sample_triangles_by_area({}), InputError);
  EXPECT_THROW(sample_triangles_by_area({{{1, 2, 3}}, {{0, 0, 0}}}), InputError);
}

}  // namespace
}  // namespace mesamis
