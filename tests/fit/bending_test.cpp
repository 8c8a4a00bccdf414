// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/bending.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "mesamis/base/parallel.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace mesamis {
namespace {

struct Case {
  TriMesh surface;
  Neighbors neighbors{surface};
  std::vector<char> on_curve = std::vector<char>(surface.points.size(), 0);
  Umbrella umbrella{neighbors, links_along_curves(neighbors, on_curve)};
  Springs springs;

  explicit Case(TriMesh given = ball_surface(5, 20)) : surface(std::move(given)) {
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const Vec3& p : surface.points) {
      springs.weight.push_back(0.6 + 0.5 * uniform(generator));
      springs.goal.push_back(
          p + 0.3 * Vec3{uniform(generator), uniform(generator), uniform(generator)});
    }
    springs.held.resize(surface.points.size(), 0);
  }

  double energy(const std::vector<Vec3>& x, double bending) const {
    const std::vector<Vec3> bent = umbrella.bent(x);
    double sum = 0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      const Vec3 away = x[p] - springs.goal[p];
      sum += springs.weight[p] * dot(away, away) + bending * dot(bent[p], bent[p]);
    }
    return sum;
  }
};

void expect_adjoint(const Umbrella& umbrella, const std::vector<Vec3>& x) {
  const std::vector<Vec3> left = umbrella.bent(x);
  ASSERT_EQ(left.size(), umbrella.row_count());
  std::vector<Vec3> y;
  for (std::size_t row = 0; row < left.size(); ++row) {
    const Vec3& p = x[row % x.size()];
    y.push_back({std::sin(p.y), 1, p.x * p.z});
  }
  double one = 0, other = 0;
  for (std::size_t row = 0; row < y.size(); ++row) one += dot(left[row], y[row]);
  for (std::size_t p = 0; p < x.size(); ++p) other += dot(x[p], umbrella.transposed(p, y));
  EXPECT_NEAR(one, other, 1e-9 * std::abs(one));
}

TEST(Umbrella, IsAdjointToItsTransposed) {
  const Case c;
  expect_adjoint(c.umbrella, c.springs.goal);
}

TEST(Umbrella, OnACurveHoldsTheCurveAlone) {
  const TriMesh fan{{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 3}},
                    {{0, 1, 3}, {0, 3, 2}, {0, 2, 4}, {0, 4, 1}}};
  const Neighbors neighbors(fan);
  const std::vector<char> on_curve{1, 1, 1, 0, 0};
  const Umbrella umbrella(neighbors, links_along_curves(neighbors, on_curve));
  EXPECT_EQ(norm(umbrella.bent(fan.points)[0]), 0) << "the curve is straight";
}

TEST(Umbrella, IsAdjointToItsTransposedWhateverLinksHoldOneWay) {
  const Case c;
  Links links(c.neighbors.points.size());
  for (std::size_t n = 0; n < links.size(); ++n) links[n] = n % 3 == 0 ? 0 : 1;
  expect_adjoint(Umbrella(c.neighbors, links), c.springs.goal);
}

TEST(Umbrella, IsAdjointToItsTransposedOnAnOpenSurface) {
  TriMesh open = ball_surface(5, 20);
  std::erase_if(open.triangles, [&](const Triangle& t) { return open.points[t[0]].z > 1; });
  const Neighbors neighbors(open);
  std::size_t one_way = 0;
  for (Index p = 0; p < std::ssize(open.points); ++p) {
    for (std::size_t n = neighbors.start[p]; n < neighbors.start[p + 1]; ++n) {
      one_way += neighbors.has(neighbors.points[n], p) ? 0 : 1;
    }
  }
  EXPECT_EQ(one_way, 0U);
  expect_adjoint(Umbrella(neighbors, Links(neighbors.points.size(), kLinked)), open.points);
}

TEST(Umbrella, IsAdjointToItsTransposedWhereTwoBoundariesGoOn) {
  const Case c;
  Links links(c.neighbors.points.size());
  for (std::size_t n = 0; n < links.size(); ++n) links[n] = static_cast<char>(n % 4);
  const Umbrella umbrella(c.neighbors, links);
  ASSERT_GT(umbrella.row_count(), c.surface.points.size());
  expect_adjoint(umbrella, c.springs.goal);
}

/// Every other place has more energy.
TEST(Relax, FindsTheLeastEnergy) {
  const Case c;
  const std::vector<Vec3> x = relax(c.umbrella, c.springs, 3, c.surface.points);
  const double least = c.energy(x, 3);
  std::mt19937 generator(6);
  std::normal_distribution<double> normal(0, 1e-2);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Vec3> other = x;
    for (Vec3& p : other) p += Vec3{normal(generator), normal(generator), normal(generator)};
    EXPECT_GT(c.energy(other, 3), least);
  }
}

TEST(Relax, EndsEarlierWhereLessAccuracyIsAskedFor) {
  Case c;
  const double least = c.energy(relax(c.umbrella, c.springs, 3, c.surface.points), 3);
  c.springs.accuracy = 0.01;
  const double near = c.energy(relax(c.umbrella, c.springs, 3, c.surface.points), 3);
  EXPECT_GT(near, least);
  EXPECT_LT(near, 1.001 * least);
}

TEST(Relax, EndsWhereAStepOnWouldBeShort) {
  Case c;
  const std::vector<Vec3> exact = relax(c.umbrella, c.springs, 3, c.surface.points);
  const auto rms_from_exact = [&] {
    const std::vector<Vec3> x = relax(c.umbrella, c.springs, 3, c.surface.points);
    double sum = 0;
    for (std::size_t p = 0; p < x.size(); ++p) sum += dot(x[p] - exact[p], x[p] - exact[p]);
    return std::sqrt(sum / static_cast<double>(x.size()));
  };
  c.springs.least_step = 0.01;
  const double near = rms_from_exact();
  EXPECT_GT(near, 0);
  EXPECT_LT(near, 0.05);
  c.springs.least_step = 0.002;
  EXPECT_LT(rms_from_exact(), near / 2);
}

TEST(Relax, LeavesWhatIsHeldAndGoesToGoalsWithoutBending) {
  Case c;
  c.springs.held[3] = 1;
  const std::vector<Vec3> x = relax(c.umbrella, c.springs, 1e-9, c.surface.points);
  EXPECT_EQ(x[3], c.surface.points[3]);
  EXPECT_LT(norm(x[4] - c.springs.goal[4]), 1e-3);
}

/// Held points move by nothing: they make no mean of steps shorter.
TEST(Relax, EndsWhereItWouldWithoutWhatIsHeldElsewhere) {
  Case alone;
  Case both(joined(alone.surface, moved(ball_surface(5, 60), {20, 0, 0})));
  const std::size_t free = alone.surface.points.size();
  std::fill(both.springs.held.begin() + static_cast<std::ptrdiff_t>(free), both.springs.held.end(),
            1);
  for (const double least_step : {0.0, 0.002, 0.01, 0.03}) {
    alone.springs.least_step = both.springs.least_step = least_step;
    const auto x = relax(alone.umbrella, alone.springs, 3, alone.surface.points);
    const auto y = relax(both.umbrella, both.springs, 3, both.surface.points);
    for (std::size_t p = 0; p < y.size(); ++p) {
      EXPECT_LT(norm(y[p] - (p < free ? x[p] : both.surface.points[p])), 1e-12) << least_step;
    }
  }
}

TEST(Relax, HasTheSameBitsForAnyNumberOfThreads) {
  const Case c;
  const auto run = [&] { return relax(c.umbrella, c.springs, 3, c.surface.points); };
  EXPECT_EQ(with_threads(1, run), with_threads(3, run));
}

}  // namespace
}  // namespace mesamis
