// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/normal_moves.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

const TriMesh kSquare{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
const std::vector<Vec3> kUp(4, {0, 0, 1});

/// Samples of a function of x and y on both triangles.
template <class Height>
std::vector<HeightSample> samples_of(Height height) {
  std::vector<HeightSample> samples;
  constexpr int kSteps = 10;
  for (Index t = 0; t < 2; ++t) {
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const double a = i / double{kSteps}, b = j / double{kSteps};
        const Triangle& k = kSquare.triangles[t];
        const Vec3 p = a * kSquare.points[k[0]] + b * kSquare.points[k[1]] +
                       (1 - a - b) * kSquare.points[k[2]];
        samples.push_back({t, {a, b, 1 - a - b}, height(p), 1});
      }
    }
  }
  return samples;
}

TEST(NormalMoves, ReachAPlaneButForThePull) {
  const auto plane = [](const Vec3& p) { return 0.2 + 0.1 * p.x - 0.3 * p.y; };
  const auto moves = normal_moves({kSquare, kUp, {0, 0, 0, 0}}, samples_of(plane));
  ASSERT_EQ(moves.size(), 4U);
  for (std::size_t p = 0; p < 4; ++p) EXPECT_NEAR(moves[p], plane(kSquare.points[p]), 0.03) << p;
}

TEST(NormalMoves, LieOnBothSidesOfABend) {
  const auto bend = [](const Vec3& p) { return p.x * (1 - p.x) + p.y * (1 - p.y); };
  const auto samples = samples_of(bend);
  const auto moves = normal_moves({kSquare, kUp, {0, 0, 0, 0}}, samples);
  int above = 0, below = 0;
  for (const HeightSample& s : samples) {
    const Triangle& k = kSquare.triangles[s.triangle];
    double at = 0;
    for (std::size_t a = 0; a < 3; ++a) at += s.place[a] * moves[k[a]];
    (s.height > at ? above : below) += 1;
  }
  EXPECT_GT(above, 30);
  EXPECT_GT(below, 30);
}

TEST(NormalMoves, LeavePointsThatStay) {
  const auto moves =
      normal_moves({kSquare, kUp, {0, 1, 0, 1}}, samples_of([](const Vec3&) { return 1.0; }));
  EXPECT_EQ(moves[1], 0);
  EXPECT_EQ(moves[3], 0);
  EXPECT_GT(moves[0], 0.8);
  EXPECT_GT(moves[2], 0.8);
}

TEST(NormalMoves, AreNoneWhereNothingIsSaid) {
  auto samples = samples_of([](const Vec3&) { return 1.0; });
  for (HeightSample& s : samples) {
    if (s.triangle == 1) s.triangle = kNoIndex;
  }
  const auto moves = normal_moves({kSquare, kUp, {0, 0, 0, 0}}, samples);
  EXPECT_EQ(moves[3], 0);
  EXPECT_GT(moves[1], 0.8);
}

}  // namespace
}  // namespace mesamis
