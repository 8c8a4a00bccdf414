// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/cell_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

TEST(CellShape, TheReferenceTetrahedronIsTheUnitSphere) {
  const double s = std::sqrt(8.0 / 9), t = std::sqrt(2.0 / 9), w = std::sqrt(2.0 / 3);
  const CellShape shape = cell_shape(
      {Vec3{s, 0, -1.0 / 3}, Vec3{-t, w, -1.0 / 3}, Vec3{-t, -w, -1.0 / 3}, Vec3{0, 0, 1}});
  for (const double lambda : shape.lambda) EXPECT_NEAR(lambda, 1, 1e-12);
  EXPECT_NEAR(shape.diameter, std::sqrt(8.0 / 3), 1e-12);
}

TEST(CellShape, StretchingTheReferenceStretchesTheEllipsoid) {
  // Aspect ratios down to 1000:1 keep the volume: product of semi-axes times |K^|.
  for (const double stretch : {1.0, 10.0, 1000.0}) {
    const std::array<Vec3, 4> p{Vec3{0, 0, 0}, {stretch, 0, 0}, {0, 1, 0}, {0, 0, 1 / stretch}};
    const CellShape shape = cell_shape(p);
    EXPECT_NEAR(shape.lambda[0] * shape.lambda[1] * shape.lambda[2] * kReferenceVolume, 1.0 / 6,
                1e-12);
    const auto s = aspect_ratios(shape);
    EXPECT_NEAR(s[0] * s[1] * s[2], 1, 1e-12);
    EXPECT_GE(s[0], s[1]);
    EXPECT_GE(s[1], s[2]);
  }
}

/// More cells than one block of a parallel loop, all of them different.
TetMesh many_cells() { return perturbed_box({{0, 0, 0}, {1, 2, 3}}, {12, 13, 14}, 0.15); }

TEST(AspectSummary, IsThatOfADirectLoop) {
  const TetMesh mesh = many_cells();
  const AspectSummary found = summarize_aspects(mesh);
  std::array<double, 3> max{}, sum{};
  for (const Cell& k : mesh.cells) {
    const auto s = aspect_ratios(cell_shape(cell_corners(mesh, k)));
    for (std::size_t i = 0; i < 3; ++i) {
      max[i] = std::max(max[i], s[i]);
      sum[i] += s[i];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(found.max[i], max[i]);
    EXPECT_NEAR(found.mean[i] * static_cast<double>(mesh.cells.size()) / sum[i], 1, 1e-12);
  }
}

TEST(AspectSummary, AgreesWithTheRatiosOfAllCells) {
  const TetMesh mesh = many_cells();
  const AspectSummary found = summarize_aspects(mesh);
  std::array<double, 3> max{};
  for (const auto& s : aspect_ratios(mesh)) {
    for (std::size_t i = 0; i < 3; ++i) max[i] = std::max(max[i], s[i]);
  }
  EXPECT_EQ(found.max, max);
}

TEST(AspectSummary, OfAlikeCellsIsThatOfOne) {
  // One brick's six cells are those of all the others.
  const AspectSummary one = summarize_aspects(box_mesh({{0, 0, 0}, {1, 2, 4}}, {1, 1, 1}));
  const AspectSummary all = summarize_aspects(box_mesh({{0, 0, 0}, {12, 24, 48}}, {12, 12, 12}));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(all.max[i] / one.max[i], 1, 1e-9);
    EXPECT_NEAR(all.mean[i] / one.mean[i], 1, 1e-9);
  }
}

TEST(AspectSummary, TheSameBitsForAnyNumberOfThreads) {
  const TetMesh mesh = many_cells();
  ASSERT_GT(mesh.cells.size(), 3 * kBlock);
  const AspectSummary one = with_threads(1, [&] { return summarize_aspects(mesh); });
  const AspectSummary three = with_threads(3, [&] { return summarize_aspects(mesh); });
  EXPECT_EQ(one.max, three.max);
  EXPECT_EQ(one.mean, three.mean);
}

TEST(AspectSummary, OfNoCellIsZero) {
  EXPECT_EQ(summarize_aspects({}).mean, (std::array<double, 3>{}));
}

}  // namespace
}  // namespace mesamis
