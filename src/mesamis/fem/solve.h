// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/fem/spd_operator.h"

namespace mesamis::detail::fem {

/// When the iteration ends.
struct SolveOptions {
  double tolerance = 1e-6;     ///< on |b - A x| / |b|, with |r|^2 = sum r_i^2 / A_ii
  int max_iterations = 2000;   ///< of conjugate gradients, in all
  int jacobi_iterations = 60;  ///< with the Jacobi preconditioner, before multigrid
};

/// How the iteration went.
struct SolveReport {
  int iterations = 0;
  double residual = 0;     ///< |b - A x| / |b| at the end, in that norm
  bool converged = false;  ///< residual <= 2 tolerance
};

/// Solves A x = b by preconditioned conjugate gradients.
///
/// With the default parameters of the method the systems are dominated by their diagonal, and the
/// Jacobi preconditioner needs 10 to 30 iterations. Where these are not enough (large beta, fine
/// cells), aggregation multigrid continues from where Jacobi stopped; its number of iterations
/// hardly depends on beta.
///
/// @param a  n unknowns.
/// @param b  right-hand side, n values of any unit.
/// @param x  in: the first guess, n values; out: the solution, in the unit of b / A. A zero b gives
///           a zero x.
/// @return reaching the iteration limit is no error: the report says so.
///
/// O(n) per iteration, three vectors besides. The same bits for any number of threads.
SolveReport solve(const SpdOperator& a, std::span<const double> b, std::span<double> x,
                  const SolveOptions& options = {});

}  // namespace mesamis::detail::fem
