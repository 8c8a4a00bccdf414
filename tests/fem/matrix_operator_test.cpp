// SPDX-License-Identifier: Apache-2.0
// MatrixOperator of spd_operator.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "mesamis/fem/mesh_space.h"
#include "mesamis/fem/spd_operator.h"
#include "support/dense_matrix.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

/// The operator of a mesh's space, and its entries.
class OperatorOfAMesh : public ::testing::Test {
 protected:
  const TetMesh mesh_ = perturbed_box({{0, 0, 0}, {1, 2, 1}}, {4, 5, 4}, 0.2);
  const MeshSpace space_{mesh_};
  const std::unique_ptr<SpdOperator> a_ = space_.diffusion({}, 0, 0.7, space_.lumped_mass());
  const DenseMatrix entries_ = dense(*a_);
};

TEST_F(OperatorOfAMesh, AppliesItsMatrix) {
  const auto& matrix = dynamic_cast<const MatrixOperator&>(*a_).matrix();
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    for (std::int64_t e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e) {
      const auto entry = static_cast<std::size_t>(e);
      EXPECT_EQ(matrix.values[entry], entries_[i][static_cast<std::size_t>(matrix.columns[entry])]);
    }
  }
}

TEST_F(OperatorOfAMesh, KnowsItsDiagonalAndRowSums) {
  const std::vector<double> sums = a_->absolute_row_sums();
  for (std::size_t i = 0; i < a_->size(); ++i) {
    EXPECT_EQ(a_->diagonal()[i], entries_[i][i]);
    double sum = 0;
    for (const double x : entries_[i]) sum += std::abs(x);
    EXPECT_NEAR(sums[i], sum, 1e-13);
  }
}

TEST_F(OperatorOfAMesh, GroupsAllUnknownsInGroupsOfAtMostEight) {
  const std::vector<Index> group = a_->aggregates();
  ASSERT_EQ(group.size(), a_->size());
  const Index count = 1 + *std::max_element(group.begin(), group.end());
  std::vector<int> members(static_cast<std::size_t>(count), 0);
  for (const Index g : group) ++members.at(static_cast<std::size_t>(g));
  for (const int m : members) {
    EXPECT_GE(m, 1);
    EXPECT_LE(m, 8);
  }
}

TEST_F(OperatorOfAMesh, CoarsensToTheGalerkinOperator) {
  const std::vector<Index> group = a_->aggregates();
  const Index count = 1 + *std::max_element(group.begin(), group.end());
  const auto groups = static_cast<std::size_t>(count);
  DenseMatrix expected(groups, std::vector<double>(groups, 0));
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (std::size_t j = 0; j < group.size(); ++j) {
      expected[static_cast<std::size_t>(group[i])][static_cast<std::size_t>(group[j])] +=
          entries_[i][j];
    }
  }
  const DenseMatrix found = dense(MatrixOperator(a_->coarsen(group, count)));
  for (std::size_t i = 0; i < groups; ++i) {
    for (std::size_t j = 0; j < groups; ++j) EXPECT_NEAR(found[i][j], expected[i][j], 1e-12);
  }
}

TEST(MatrixOperator, PairsAlongTheStrongCouplings) {
  // Eight chains of eight unknowns, coupled strongly along a chain and weakly across.
  constexpr Index kLength = 8;
  std::vector<Triplet> triplets;
  const auto couple = [&](Index i, Index j, double strength) {
    triplets.push_back({i, j, -strength}), triplets.push_back({j, i, -strength});
    triplets.push_back({i, i, strength}), triplets.push_back({j, j, strength});
  };
  for (Index chain = 0; chain < kLength; ++chain) {
    for (Index n = 0; n < kLength; ++n) {
      const Index i = chain * kLength + n;
      triplets.push_back({i, i, 1e-3});
      if (n + 1 < kLength) couple(i, i + 1, 1);
      if (chain + 1 < kLength) couple(i, i + kLength, 1e-3);
    }
  }
  const MatrixOperator a(from_triplets(kLength * kLength, triplets));
  const std::vector<Index> group = a.aggregates();
  for (Index chain = 0; chain < kLength; ++chain) {
    const auto begin = group.begin() + chain * kLength;
    EXPECT_EQ(std::set<Index>(begin, begin + kLength).size(), 1u) << chain;
  }
}

TEST(MatrixOperator, LeavesUncoupledUnknownsAlone) {
  const MatrixOperator a(from_triplets(3, {{0, 0, 1.0}, {1, 1, 2.0}, {2, 2, 3.0}}));
  EXPECT_EQ(a.aggregates(), (std::vector<Index>{0, 1, 2}));
}

}  // namespace
}  // namespace mesamis
