// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/label_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "mesamis/base/parallel.h"
#include "support/ball_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

constexpr double kPlane = 7.5;  // through the ball, where the image shows nothing

Volume ball() { return make_ball({.size = 20, .radius = 6}); }

/// Two labels that meet in a plane.
Volume halves() {
  Volume labels = ball();
  for (std::size_t n = 0; n < labels.samples.size(); ++n) {
    labels.samples[n] = static_cast<double>(n % 20) > kPlane ? 1.0F : 0.0F;
  }
  return labels;
}

Settings few_cells() {
  Settings settings;
  settings.max_tets = 4000;
  settings.adaptations = 2;
  return settings;
}

/// Mean width along x of the cells that a plane x = at cuts, by volume, near the ball's middle.
double width_at(const TetMesh& mesh, double at) {
  double sum = 0, weights = 0;
  for (const Cell& cell : mesh.cells) {
    const auto p = cell_corners(mesh, cell);
    const auto [lo, hi] = std::minmax({p[0].x, p[1].x, p[2].x, p[3].x});
    const Vec3 middle = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    if (lo > at || hi < at || norm(middle - Vec3{at, 9.5, 9.5}) > 4) continue;
    sum += hi - lo;
    weights += 1;
  }
  return sum / weights;
}

TEST(LabelMesh, IsFineWhereLabelsMeetThoughTheImageShowsNothing) {
  const Volume scan = ball();
  const std::vector<Volume> labels{halves()};
  const Result with = mesh_beside_labels(scan, labels, few_cells());
  const Result without = mesh_beside_labels(scan, {}, few_cells());
  EXPECT_LT(width_at(with.mesh, kPlane), 0.6 * width_at(without.mesh, kPlane));
}

TEST(LabelMesh, WithoutLabelsIsTheMeshOfTheImage) {
  const Volume scan = ball();
  const Result mesh = mesh_beside_labels(scan, {}, few_cells());
  const Result plain = mes_amis(scan, few_cells());
  EXPECT_EQ(mesh.mesh.cells, plain.mesh.cells);
  EXPECT_EQ(mesh.mesh.points, plain.mesh.points);
  EXPECT_EQ(mesh.u, plain.u);
}

TEST(LabelMesh, FillsTheBoxAndKeepsToTheCellsAsked) {
  const std::vector<Volume> labels{halves(), halves()};
  const Result result = mesh_beside_labels(ball(), labels, few_cells());
  double volume = 0;
  for (std::size_t c = 0; c < result.mesh.cells.size(); ++c) {
    volume += cell_volume(result.mesh, static_cast<Index>(c));
  }
  EXPECT_NEAR(volume, 19.0 * 19 * 19, 1e-6);
  EXPECT_LE(std::ssize(result.mesh.cells), 4200);
  EXPECT_EQ(result.u.size(), result.mesh.points.size());
  EXPECT_TRUE(result.surface.triangles.empty());
}

TEST(LabelMesh, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Volume> labels{halves()};
  const auto run = [&] { return mesh_beside_labels(ball(), labels, few_cells()); };
  const Result one = with_threads(1, run), two = with_threads(2, run);
  EXPECT_EQ(one.mesh.points, two.mesh.points);
  EXPECT_EQ(one.mesh.cells, two.mesh.cells);
}

TEST(LabelMesh, NeedsTheGridOfTheImage) {
  const std::vector<Volume> labels{make_ball({.size = 19, .radius = 6})};
  EXPECT_REFUSED(mesh_beside_labels(ball(), labels, few_cells()),
                 ::testing::HasSubstr("the grid of the image"));
}

}  // namespace
}  // namespace mesamis
