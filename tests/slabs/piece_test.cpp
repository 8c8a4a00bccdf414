// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/metric_fields.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

/// Values that follow from the place, so that a node in wrong company is seen.
Piece whole() {
  Piece piece{perturbed_box(kUnitBox, {4, 3, 6}, 0.2), {}};
  for (const Vec3& p : piece.mesh.points) {
    piece.nodes.push_back({p.x, p.y, p.z, (1 + p.x) * kIdentity3});
  }
  return piece;
}

Piece side(const Piece& piece, bool above) {
  return select(piece,
                [&](const Cell& cell) { return (height_of(piece.mesh, cell) >= 0.5) == above; });
}

void expect_values_in_place(const Piece& piece) {
  ASSERT_EQ(piece.nodes.size(), piece.mesh.points.size());
  for (std::size_t n = 0; n < piece.nodes.size(); ++n) {
    const Vec3& p = piece.mesh.points[n];
    EXPECT_EQ(piece.nodes[n].u, p.x);
    EXPECT_EQ(piece.nodes[n].v, p.y);
    EXPECT_EQ(piece.nodes[n].f, p.z);
    EXPECT_EQ(piece.nodes[n].metric.yy, 1 + p.x);
  }
}

/// Cells by the coordinates of their corners: they do not depend on the nodes' numbers.
std::vector<std::array<double, 12>> cells_by_place(const Piece& piece) {
  std::vector<std::array<double, 12>> cells;
  for (const Cell& cell : piece.mesh.cells) {
    auto& places = cells.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& p = piece.mesh.points[static_cast<std::size_t>(cell[i])];
      for (int a = 0; a < 3; ++a) places[3 * i + static_cast<std::size_t>(a)] = p[a];
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

TEST(Piece, SelectedPartsJoinToTheWhole) {
  const Piece all = whole();
  const Piece low = side(all, false), high = side(all, true);
  expect_values_in_place(low);
  expect_values_in_place(high);
  const std::array<const Piece*, 2> parts{&low, &high};
  const Piece joined = join(parts);
  EXPECT_EQ(joined.mesh.points.size(), all.mesh.points.size());
  EXPECT_EQ(cells_by_place(joined), cells_by_place(all));
  EXPECT_EQ(find_flaw(joined.mesh, kUnitBox), "");
  expect_values_in_place(joined);
  // And back: the parts are the first and the last cells.
  const Cell* first = joined.mesh.cells.data();
  const auto is_low = [&](const Cell& cell) { return &cell - first < std::ssize(low.mesh.cells); };
  EXPECT_EQ(cells_by_place(select(joined, is_low)), cells_by_place(low));
}

TEST(Piece, OfACommonNodeTheFirstValuesStay) {
  const Piece low = side(whole(), false);
  Piece other = low;
  for (NodeValues& node : other.nodes) node.u = 77;
  const std::array<const Piece*, 2> parts{&low, &other};
  const Piece joined = join(parts);
  EXPECT_EQ(joined.nodes.size(), low.nodes.size());
  expect_values_in_place(joined);
}

TEST(Piece, ZeroAndMinusZeroAreOnePlace) {
  const Piece plus{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}},
                   std::vector<NodeValues>(4)};
  const Piece minus{{{{0, -0.0, 0}, {1, 0, -0.0}, {0, 1, 0}, {0, 0, -1}}, {{0, 2, 1, 3}}},
                    std::vector<NodeValues>(4)};
  const std::array<const Piece*, 2> parts{&plus, &minus};
  EXPECT_EQ(join(parts).mesh.points.size(), 5U);
}

TEST(Piece, AnEmptySelectionIsEmpty) {
  const Piece none = select(whole(), [](const Cell&) { return false; });
  EXPECT_TRUE(none.mesh.cells.empty());
  EXPECT_TRUE(none.mesh.points.empty());
  const Piece all = whole();
  const std::array<const Piece*, 2> parts{&none, &all};
  EXPECT_EQ(cells_by_place(join(parts)), cells_by_place(all));
}

TEST(Piece, IsReadAsItWasWritten) {
  ArchiveWriter written;
  add_piece(written, whole());
  ArchiveReader archive(std::string(written.bytes()), "file");
  const Piece read = next_piece(archive);
  EXPECT_EQ(read.mesh.points, whole().mesh.points);
  EXPECT_EQ(read.mesh.cells, whole().mesh.cells);
  expect_values_in_place(read);
}

TEST(Piece, ACellIsNearAHeightThatItReachesOrPasses) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 4}}, {{0, 1, 2, 3}}};
  EXPECT_EQ(height_of(mesh, mesh.cells[0]), 1);
  EXPECT_TRUE(is_near(mesh, mesh.cells[0], 4.5, 0.6));
  EXPECT_TRUE(is_near(mesh, mesh.cells[0], -0.5, 0.6));
  EXPECT_TRUE(is_near(mesh, mesh.cells[0], 2, 0.6)) << "no corner is near, but it passes";
  EXPECT_FALSE(is_near(mesh, mesh.cells[0], 4.5, 0.5));
  EXPECT_FALSE(is_near(mesh, mesh.cells[0], -0.5, 0.5));
}

TEST(LumpedMass, IsTheVolumeOfTheMesh) {
  const std::vector<double> mass = lumped_mass_of(whole().mesh);
  EXPECT_EQ(mass.size(), whole().mesh.points.size());
  EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.0), 1, 1e-12);
  const TetMesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 4}}, {{0, 1, 2, 3}}};
  for (const double quarter : lumped_mass_of(one)) EXPECT_NEAR(quarter, 4.0 / 6 / 4, 1e-15);
}

}  // namespace
}  // namespace mesamis
