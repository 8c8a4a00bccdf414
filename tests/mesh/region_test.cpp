// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/region.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "support/perturbed_box.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

double volume_of(const TetMesh& mesh, std::span<const Index> cells) {
  double sum = 0;
  for (const Index c : cells) sum += cell_volume(mesh, c);
  return sum;
}

std::vector<Index> all_cells(const TetMesh& mesh) {
  std::vector<Index> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

/// The six cells of each brick that `wanted` says, of a box of unit bricks.
template <class Wanted>
std::vector<Index> cells_of_bricks(const std::array<Index, 3>& n, Wanted wanted) {
  std::vector<Index> cells;
  for (Index brick = 0; brick < n[0] * n[1] * n[2]; ++brick) {
    if (!wanted(brick % n[0], brick / n[0] % n[1], brick / n[0] / n[1])) continue;
    for (Index i = 0; i < 6; ++i) cells.push_back(6 * brick + i);
  }
  return cells;
}

TetMesh bricks(const std::array<Index, 3>& n) {
  return box_mesh({{0, 0, 0}, {double(n[0]), double(n[1]), double(n[2])}}, n);
}

TEST(MeshVolume, OfAPerturbedBoxIsTheBoxes) {
  EXPECT_NEAR(mesh_volume(perturbed_box({{1, 2, 3}, {3, 5, 7}}, {3, 4, 5}, 0.2)), 24, 1e-12);
  EXPECT_EQ(mesh_volume({}), 0);
}

TEST(ShareAboveZero, KnowsCornersWedgesAndEnds) {
  EXPECT_EQ(share_above_zero({1, 2, 3, 4}), 1);
  EXPECT_EQ(share_above_zero({-1, -2, -3, -4}), 0);
  EXPECT_EQ(share_above_zero({0, 0, 0, 0}), 0);
  EXPECT_EQ(share_above_zero({0, 0, 0, 1}), 1);
  EXPECT_EQ(share_above_zero({0, 0, 0, -1}), 0);
  EXPECT_DOUBLE_EQ(share_above_zero({-1, 1, -1, -1}), 1.0 / 8);
  EXPECT_DOUBLE_EQ(share_above_zero({1, 1, -1, 1}), 7.0 / 8);
  EXPECT_DOUBLE_EQ(share_above_zero({1, -1, 1, -1}), 0.5);
  EXPECT_DOUBLE_EQ(share_above_zero({1, 1, 0, -1}), 0.75);
}

TEST(ShareAboveZero, AgreesWithCountingPoints) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::exponential_distribution<double> exponential;
  for (int trial = 0; trial < 40; ++trial) {
    const std::array<double, 4> d{normal(random), normal(random), normal(random), normal(random)};
    int above = 0;
    constexpr int kPoints = 20000;
    for (int i = 0; i < kPoints; ++i) {
      double value = 0;
      for (const double x : d) value += exponential(random) * x;
      above += value > 0;
    }
    EXPECT_NEAR(share_above_zero(d), above / double(kPoints), 0.02);
    EXPECT_NEAR(share_above_zero(d) + share_above_zero({-d[0], -d[1], -d[2], -d[3]}), 1, 1e-14);
  }
}

TEST(CellsMostlyAbove, ApproachThePlaneAndTakeNoneTwice) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {2, 3, 4}}, {8, 9, 10}, 0.25);
  std::vector<double> height, depth;
  for (const Vec3& p : mesh.points) {
    height.push_back(p.x + 0.3 * p.y);
    depth.push_back(-height.back());
  }
  const auto above = cells_mostly_above(mesh, height, 1.2);
  const auto below = cells_mostly_above(mesh, depth, -1.2);
  EXPECT_TRUE(std::is_sorted(above.begin(), above.end()));
  EXPECT_EQ(above.size() + below.size(), mesh.cells.size());
  const double exact = 4 * (2 * 3 - 3 * (1.2 - 0.3 * 1.5));  // the plane leaves by both y faces
  EXPECT_NEAR(volume_of(mesh, above) / exact, 1, 0.01);
}

TEST(CellsMostlyAbove, RefuseWhatIsNoField) {
  const TetMesh mesh = bricks({1, 1, 1});
  const std::vector<double> odd(8, std::nan("")), few(7, 1);
  EXPECT_REFUSED(cells_mostly_above(mesh, odd, 0), HasSubstr("finite"));
  EXPECT_REFUSED(cells_mostly_above(mesh, few, 0), HasSubstr("one value per node (8), found 7"));
  EXPECT_REFUSED(cell_means(mesh, few), HasSubstr("found 7"));
}

TEST(CellMeans, AreTheValuesAtTheCentroids) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 1}}, {2, 2, 2}, 0.2);
  std::vector<double> values;
  for (const Vec3& p : mesh.points) values.push_back(1 + 2 * p.x - p.y + 5 * p.z);
  const auto means = cell_means(mesh, values);
  for (std::size_t c = 0; c < means.size(); ++c) {
    const auto p = cell_corners(mesh, mesh.cells[c]);
    const Vec3 m = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    EXPECT_NEAR(means[c], 1 + 2 * m.x - m.y + 5 * m.z, 1e-14);
  }
}

TEST(RestrictMesh, WithAllCellsIsTheMeshItself) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 2, 3}}, {3, 2, 2}, 0.2);
  const RestrictedMesh part = restrict_mesh(mesh, all_cells(mesh));
  EXPECT_EQ(part.mesh.points, mesh.points);
  EXPECT_EQ(part.mesh.cells, mesh.cells);
}

TEST(RestrictMesh, KeepsVolumesPlacesAndOrientationAndLeavesNoPointOver) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 2, 3}}, {4, 4, 4}, 0.2);
  std::vector<Index> cells = all_cells(mesh);
  std::shuffle(cells.begin(), cells.end(), std::mt19937(2));
  cells.resize(50);
  const RestrictedMesh part = restrict_mesh(mesh, cells);
  ASSERT_EQ(part.mesh.cells.size(), cells.size());
  std::set<Index> used;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    EXPECT_EQ(cell_volume(part.mesh, static_cast<Index>(c)), cell_volume(mesh, cells[c]));
    used.insert(part.mesh.cells[c].begin(), part.mesh.cells[c].end());
  }
  EXPECT_EQ(used.size(), part.mesh.points.size());
  EXPECT_TRUE(std::is_sorted(part.nodes.begin(), part.nodes.end()));
  for (std::size_t n = 0; n < part.nodes.size(); ++n) {
    EXPECT_EQ(part.mesh.points[n], mesh.points[part.nodes[n]]);
  }
}

TEST(RestrictMesh, ToNothingIsEmptyAndToMissingCellsRefused) {
  const TetMesh mesh = bricks({1, 1, 1});
  EXPECT_TRUE(restrict_mesh(mesh, {}).mesh.points.empty());
  for (const Index cell : {-1, 6}) {
    const std::vector<Index> cells{cell};
    EXPECT_REFUSED(restrict_mesh(mesh, cells), HasSubstr("there is no cell"));
  }
}

TEST(FaceParts, AreNotHeldTogetherByEdgesAndPoints) {
  EXPECT_EQ(count_face_parts(bricks({3, 2, 2})), 1);
  const std::array<Index, 3> n{2, 2, 2};
  const TetMesh mesh = bricks(n);
  const auto edge = cells_of_bricks(n, [](Index i, Index j, Index k) { return i == j && k == 0; });
  const auto point = cells_of_bricks(n, [](Index i, Index j, Index k) { return i == j && j == k; });
  EXPECT_EQ(count_face_parts(restrict_mesh(mesh, edge).mesh), 2);
  EXPECT_EQ(count_face_parts(restrict_mesh(mesh, point).mesh), 2);
  EXPECT_EQ(count_face_parts(TetMesh{}), 0);
  const std::vector<Index> parts = face_parts(restrict_mesh(mesh, edge).mesh);
  EXPECT_THAT(parts, testing::ElementsAre(0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1));
}

TEST(SelectCells, DropsSmallPartsAndKeepsTheLargest) {
  const std::array<Index, 3> n{9, 1, 1};
  const TetMesh mesh = bricks(n);
  const auto row = [&n](std::set<Index> wanted) {
    return cells_of_bricks(n, [&](Index i, Index, Index) { return wanted.count(i) > 0; });
  };
  const auto cells = row({0, 2, 3, 5, 6, 7});  // parts of 1, 2 and 3 mm^3
  EXPECT_EQ(select_cells(mesh, cells, {}), cells);
  EXPECT_EQ(select_cells(mesh, cells, {.volume_min = 1.5}), row({2, 3, 5, 6, 7}));
  EXPECT_EQ(select_cells(mesh, cells, {.keep_largest = 1}), row({5, 6, 7}));
  EXPECT_EQ(select_cells(mesh, cells, {.keep_largest = 2}), row({2, 3, 5, 6, 7}));
  EXPECT_TRUE(select_cells(mesh, cells, {.volume_min = 100}).empty());
}

TEST(SelectCells, FillsCavitiesButNotWhatReachesTheBoundary) {
  const std::array<Index, 3> n{7, 5, 5};
  const TetMesh mesh = bricks(n);
  const auto hollow = cells_of_bricks(n, [](Index i, Index j, Index k) {
    const bool in = i > 0 && j > 0 && k > 0 && i < 6 && j < 4 && k < 4;
    const bool hole = j == 2 && k == 2 && i >= 2 && i <= 4;
    return in && !hole;
  });
  const auto full = select_cells(mesh, hollow, {.fill_cavities = true});
  EXPECT_EQ(full.size(), 6u * 5 * 3 * 3);
  EXPECT_NEAR(volume_of(mesh, full), 45, 1e-12);
  EXPECT_EQ(select_cells(mesh, hollow, {.volume_min = 2}), hollow) << "the cavity has 3 mm^3";
  EXPECT_EQ(select_cells(mesh, hollow, {.volume_min = 4}), full);
  const auto open = cells_of_bricks(n, [](Index, Index j, Index k) { return j != 2 || k != 2; });
  EXPECT_EQ(select_cells(mesh, open, {.fill_cavities = true}), open);
}

}  // namespace
}  // namespace mesamis
