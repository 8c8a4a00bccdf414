// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "mesamis/fem/spd_operator.h"

/// Matrices with every entry stored: what operators and solvers are compared with.
namespace mesamis {

using DenseMatrix = std::vector<std::vector<double>>;

/// The columns of an operator, one unit vector after the other.
inline DenseMatrix dense(const SpdOperator& a) {
  const std::size_t n = a.size();
  DenseMatrix matrix(n, std::vector<double>(n));
  std::vector<double> unit(n, 0), column(n);
  for (std::size_t j = 0; j < n; ++j) {
    unit[j] = 1;
    a.apply(unit, column);
    for (std::size_t i = 0; i < n; ++i) matrix[i][j] = column[i];
    unit[j] = 0;
  }
  return matrix;
}

/// Solves A x = b by Gaussian elimination; A is symmetric positive definite.
inline std::vector<double> solve_dense(DenseMatrix a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

}  // namespace mesamis
