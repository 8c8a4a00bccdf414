// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/sparse_matrix.h"

namespace mesamis {

/// A symmetric positive definite linear operator, as much of it as a solver asks for.
class SpdOperator {
 public:
  virtual ~SpdOperator() = default;
  virtual std::size_t size() const = 0;
  virtual const std::vector<double>& diagonal() const = 0;

  /// y = A x
  virtual void apply(std::span<const double> x, std::span<double> y) const = 0;

  /// Row sums of absolute values: the scaling of the l1-Jacobi smoother.
  virtual std::vector<double> absolute_row_sums() const = 0;

  /// Groups of a few strongly coupled unknowns, numbered from 0: the next level of multigrid.
  virtual std::vector<Index> aggregates() const = 0;

  /// The Galerkin operator on the groups: A_IJ = sum of a_ij over i in I, j in J.
  virtual SparseMatrix coarsen(std::span<const Index> aggregate, Index count) const = 0;
};

/// A sparse matrix as an operator; it owns the matrix.
class MatrixOperator : public SpdOperator {
 public:
  explicit MatrixOperator(SparseMatrix matrix);
  std::size_t size() const override { return diagonal_.size(); }
  const std::vector<double>& diagonal() const override { return diagonal_; }
  void apply(std::span<const double> x, std::span<double> y) const override;
  std::vector<double> absolute_row_sums() const override;
  std::vector<Index> aggregates() const override;
  SparseMatrix coarsen(std::span<const Index> aggregate, Index count) const override;
  const SparseMatrix& matrix() const { return matrix_; }

 private:
  SparseMatrix matrix_;
  std::vector<double> diagonal_;
};

}  // namespace mesamis
