// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/grid_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mesamis/base/error.h"
#include "mesamis/fem/mesh_space.h"

namespace mesamis {
namespace {

/// The grid and the stored mesh of its cells must be the same space.
class GridAgainstMesh : public ::testing::Test {
 protected:
  const KuhnGrid grid_{{5, 4, 6}, {1, 0.6, 1.7}};
  const TetMesh mesh_ = box_mesh(grid_.box(), {4, 3, 5});
  const GridSpace a_{grid_};
  const MeshSpace b_{mesh_};

  std::vector<double> wave(double frequency) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < grid_.node_count(); ++i) {
      values.push_back(1.5 + std::sin(frequency * static_cast<double>(i)));
    }
    return values;
  }
  static void expect_equal(const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
  }
};

TEST_F(GridAgainstMesh, CellsFillTheBox) {
  EXPECT_EQ(grid_.cell_count(), std::ssize(mesh_.cells));
  for (Index c = 0; c < std::ssize(mesh_.cells); ++c) {
    EXPECT_NEAR(grid_.cell_volume(), cell_volume(mesh_, c), 1e-12);
  }
}

TEST_F(GridAgainstMesh, LumpedMass) { expect_equal(a_.lumped_mass(), b_.lumped_mass()); }

TEST_F(GridAgainstMesh, GradientSquares) {
  expect_equal(a_.gradient_squares(wave(2)), b_.gradient_squares(wave(2)));
}

TEST_F(GridAgainstMesh, Diffusion) {
  for (const auto& w : {wave(3), std::vector<double>{}}) {
    const auto a = a_.diffusion(w, 1.3, 0.2, wave(5));
    const auto b = b_.diffusion(w, 1.3, 0.2, wave(5));
    std::vector<double> x = wave(7), ax(x.size()), bx(x.size());
    a->apply(x, ax);
    b->apply(x, bx);
    expect_equal(ax, bx);
    expect_equal(a->diagonal(), b->diagonal());
    expect_equal(a->absolute_row_sums(), b->absolute_row_sums());
  }
}

TEST_F(GridAgainstMesh, CoarseOperatorsAreGalerkin) {
  const auto a = a_.diffusion(wave(3), 1.3, 0.2, wave(5));
  const auto group = a->aggregates();
  const Index count = 1 + *std::max_element(group.begin(), group.end());
  EXPECT_EQ(count, 3 * 2 * 3);
  const MatrixOperator coarse(a->coarsen(group, count));
  std::vector<double> x(static_cast<std::size_t>(count)), cx(x.size()), fine, fx(group.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::cos(static_cast<double>(i));
  for (const Index g : group) fine.push_back(x[g]);
  coarse.apply(x, cx);
  a->apply(fine, fx);
  std::vector<double> restricted(x.size(), 0);
  for (std::size_t i = 0; i < group.size(); ++i) restricted[group[i]] += fx[i];
  expect_equal(cx, restricted);
}

TEST(GridSpace, RefusesAFlatGrid) { EXPECT_THROW(GridSpace({{5, 5, 1}, {1, 1, 1}}), InputError); }

}  // namespace
}  // namespace mesamis
