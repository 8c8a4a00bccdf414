// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesamis/base/parallel.h"
#include "mesamis/fem/spd_operator.h"

namespace mesamis::detail::fem {
namespace {

/// Pairs each row with the unpaired neighbour it is coupled to most strongly. A row whose
/// neighbours are all taken stays alone.
std::vector<Index> match_pairs(const SparseMatrix& a, Index* groups) {
  std::vector<Index> group(a.rows(), kNoIndex);
  *groups = 0;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    if (group[i] != kNoIndex) continue;
    Index partner = kNoIndex;
    double strongest = 0;
    for (std::int64_t e = a.row_start[i]; e < a.row_start[i + 1]; ++e) {
      const Index j = a.columns[static_cast<std::size_t>(e)];
      const double coupling = -a.values[static_cast<std::size_t>(e)];
      if (j == static_cast<Index>(i) || group[static_cast<std::size_t>(j)] != kNoIndex) continue;
      if (coupling > strongest) {
        strongest = coupling;
        partner = j;
      }
    }
    group[i] = *groups;
    if (partner != kNoIndex) group[static_cast<std::size_t>(partner)] = *groups;
    ++*groups;
  }
  return group;
}

/// Rows of each group, in increasing order.
std::vector<std::vector<Index>> members_of(std::span<const Index> group, Index count) {
  std::vector<std::vector<Index>> members(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < group.size(); ++i) {
    members[static_cast<std::size_t>(group[i])].push_back(static_cast<Index>(i));
  }
  return members;
}

SparseMatrix galerkin(const SparseMatrix& a, std::span<const Index> group, Index count) {
  const auto members = members_of(group, count);
  SparseMatrix coarse;
  coarse.row_start.assign(1, 0);
  std::vector<double> sum(static_cast<std::size_t>(count), 0);
  std::vector<char> seen(static_cast<std::size_t>(count), 0);
  for (const auto& rows : members) {
    std::vector<Index> columns;
    for (const Index i : rows) {
      for (std::int64_t e = a.row_start[i]; e < a.row_start[i + 1]; ++e) {
        const Index column = group[a.columns[static_cast<std::size_t>(e)]];
        if (!seen[column]) columns.push_back(column);
        seen[column] = 1;
        sum[column] += a.values[static_cast<std::size_t>(e)];
      }
    }
    std::sort(columns.begin(), columns.end());
    for (const Index column : columns) {
      coarse.columns.push_back(column);
      coarse.values.push_back(sum[column]);
      sum[column] = 0;
      seen[column] = 0;
    }
    coarse.row_start.push_back(static_cast<std::int64_t>(coarse.columns.size()));
  }
  return coarse;
}

}  // namespace

MatrixOperator::MatrixOperator(SparseMatrix matrix) : matrix_(std::move(matrix)) {
  diagonal_.assign(matrix_.rows(), 0);
  parallel_for(matrix_.rows(), [this](std::size_t i) {
    for (std::int64_t e = matrix_.row_start[i]; e < matrix_.row_start[i + 1]; ++e) {
      if (matrix_.columns[static_cast<std::size_t>(e)] == static_cast<Index>(i)) {
        diagonal_[i] = matrix_.values[static_cast<std::size_t>(e)];
      }
    }
  });
}

void MatrixOperator::apply(std::span<const double> x, std::span<double> y) const {
  parallel_for(size(), [&](std::size_t i) {
    double sum = 0;
    for (std::int64_t e = matrix_.row_start[i]; e < matrix_.row_start[i + 1]; ++e) {
      sum += matrix_.values[static_cast<std::size_t>(e)] *
             x[matrix_.columns[static_cast<std::size_t>(e)]];
    }
    y[i] = sum;
  });
}

std::vector<double> MatrixOperator::absolute_row_sums() const {
  std::vector<double> sums(size(), 0);
  parallel_for(size(), [&](std::size_t i) {
    for (std::int64_t e = matrix_.row_start[i]; e < matrix_.row_start[i + 1]; ++e) {
      sums[i] += std::abs(matrix_.values[static_cast<std::size_t>(e)]);
    }
  });
  return sums;
}

std::vector<Index> MatrixOperator::aggregates() const {
  // Three rounds of pairing follow the strong couplings of stretched cells and give groups of
  // about eight, as 2x2x2 blocks do on a grid.
  std::vector<Index> group(size());
  std::iota(group.begin(), group.end(), 0);
  SparseMatrix coarse;
  for (int round = 0; round < 3; ++round) {
    Index count = 0;
    const SparseMatrix& current = round == 0 ? matrix_ : coarse;
    const std::vector<Index> pairs = match_pairs(current, &count);
    for (Index& g : group) g = pairs[static_cast<std::size_t>(g)];
    if (round < 2) coarse = galerkin(current, pairs, count);
  }
  return group;
}

SparseMatrix MatrixOperator::coarsen(std::span<const Index> aggregate, Index count) const {
  return galerkin(matrix_, aggregate, count);
}

}  // namespace mesamis::detail::fem
