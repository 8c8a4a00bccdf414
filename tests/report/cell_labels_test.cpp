// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/cell_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/base/parallel.h"
#include "support/level_set.h"

namespace mesamis {
namespace {

const Vec3 kFirst{9.1, 9.7, 10.2}, kSecond{15.3, 10.1, 9.8};
constexpr double kRadius = 5;

TriMesh ball_at(const Vec3& center) {
  return level_set({{0, 0, 0}, {24, 20, 20}}, {48, 40, 40},
                   [center](const Vec3& p) { return kRadius - norm(p - center); });
}

std::vector<Vec3> random_points(int count) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(-1, 25);
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n) {
    const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
    points.push_back({x, y, z});
  }
  return points;
}

struct TwoBalls {
  TriMesh first = ball_at(kFirst), second = ball_at(kSecond);
  std::vector<FoundObject> objects{{first, {"first ball", 7, 0, {}}},
                                   {second, {"2nd/b\xc3\xa4ll", 9, 0, {}}}};
};

TEST(ObjectsAt, FindsTheBallOfEachPointAndTheLaterOfTwo) {
  const TwoBalls balls;
  const auto points = random_points(20000);
  const auto found = objects_at(points, balls.objects);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const double a = norm(points[n] - kFirst), b = norm(points[n] - kSecond);
    if (std::abs(a - kRadius) < 0.05 || std::abs(b - kRadius) < 0.05) continue;
    const Index expected = b < kRadius ? 1 : a < kRadius ? 0 : kNoIndex;
    ASSERT_EQ(found[n], expected) << points[n].x << ' ' << points[n].y << ' ' << points[n].z;
  }
}

TEST(ObjectsAt, LinesThroughCornersAreNoTrap) {
  const TwoBalls balls;
  std::vector<Vec3> points;
  for (const Vec3& p : balls.first.points) points.push_back({kFirst.x, p.y, p.z});
  const auto found = objects_at(points, {balls.objects.data(), 1});
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (norm(points[n] - kFirst) < 0.95 * kRadius) {
      EXPECT_EQ(found[n], 0);
    }
  }
}

TEST(ObjectsAt, IsTheSameForAnyNumberOfThreads) {
  const TwoBalls balls;
  const auto points = random_points(5000);
  EXPECT_EQ(with_threads(1, [&] { return objects_at(points, balls.objects); }),
            with_threads(2, [&] { return objects_at(points, balls.objects); }));
}

TEST(ObjectsAt, NothingIsWhereNothingIs) {
  EXPECT_TRUE(objects_at({}, {}).empty());
  EXPECT_EQ(objects_at(random_points(3), {}), std::vector<Index>(3, kNoIndex));
}

TEST(LabelSets, ShareTheCellsAmongBackgroundAndObjects) {
  const TwoBalls balls;
  const TetMesh mesh = box_mesh({{0, 0, 0}, {24, 20, 20}}, {24, 20, 20});
  const CellSets sets = label_sets(mesh, balls.objects);
  ASSERT_EQ(sets.sets.size(), 3u);
  EXPECT_EQ(sets.sets[0].name, "BACKGROUND");
  EXPECT_EQ(sets.sets[1].name, "L7_first_ball");
  EXPECT_EQ(sets.sets[2].name, "L9_2nd_b_ll");
  std::vector<double> volume(3, 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    volume[static_cast<std::size_t>(sets.of_cell[c])] += cell_volume(mesh, static_cast<Index>(c));
  }
  const double ball = 4.0 / 3 * std::acos(-1.0) * kRadius * kRadius * kRadius;
  EXPECT_NEAR(volume[2], ball, 0.02 * ball);
  EXPECT_LT(volume[1], ball);
  EXPECT_NEAR(volume[0] + volume[1] + volume[2], 24 * 20 * 20, 1e-6);
}

}  // namespace
}  // namespace mesamis
