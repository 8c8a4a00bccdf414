// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/sparse_matrix.h"

namespace mesamis::detail::fem {

/// A symmetric positive definite linear operator A of n unknowns, as solve() needs it.
class SpdOperator {
 public:
  virtual ~SpdOperator() = default;
  /// The number of unknowns n.
  virtual std::size_t size() const = 0;
  /// The n entries a_ii > 0, any unit.
  virtual const std::vector<double>& diagonal() const = 0;

  /// Applies the operator: y = A x. O(n) for rows of bounded length.
  /// @param x  n values of any unit.
  /// @param y  n values, overwritten; must not overlap x.
  virtual void apply(std::span<const double> x, std::span<double> y) const = 0;

  /// Computes the n sums of |a_ij| over a row, in the unit of the entries: the scaling of the
  /// l1-Jacobi smoother. O(n) for rows of bounded length.
  virtual std::vector<double> absolute_row_sums() const = 0;

  /// Groups the unknowns: the group of each, n numbers from 0 without gaps. A group is a few
  /// strongly coupled unknowns, which are one unknown on the next level of multigrid.
  ///
  /// O(n) for rows of bounded length.
  virtual std::vector<Index> aggregates() const = 0;

  /// Makes the Galerkin operator on the groups: A_IJ = sum of a_ij over i in I, j in J.
  /// @param aggregate  the group of each unknown, n numbers in [0, count).
  /// @param count      number of groups.
  ///
  /// O(n log n).
  virtual SparseMatrix coarsen(std::span<const Index> aggregate, Index count) const = 0;
};

/// A sparse matrix as an operator; it owns the matrix.
class MatrixOperator : public SpdOperator {
 public:
  /// Takes over the matrix and copies its diagonal. O(n) for rows of bounded length.
  /// @param matrix  symmetric positive definite, the diagonal stored.
  explicit MatrixOperator(SparseMatrix matrix);
  std::size_t size() const override { return diagonal_.size(); }
  const std::vector<double>& diagonal() const override { return diagonal_; }
  void apply(std::span<const double> x, std::span<double> y) const override;
  std::vector<double> absolute_row_sums() const override;
  std::vector<Index> aggregates() const override;
  SparseMatrix coarsen(std::span<const Index> aggregate, Index count) const override;
  /// The matrix applied.
  const SparseMatrix& matrix() const noexcept { return matrix_; }

 private:
  SparseMatrix matrix_;
  std::vector<double> diagonal_;
};

}  // namespace mesamis::detail::fem
