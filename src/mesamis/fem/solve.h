// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/fem/spd_operator.h"

namespace mesamis {

struct SolveOptions {
  double tolerance = 1e-8;     ///< on |b - A x| / |b|, with |r|^2 = sum r_i^2 / A_ii
  int max_iterations = 2000;   ///< of conjugate gradients, in all
  int jacobi_iterations = 60;  ///< tried first; what is not solved by then goes to multigrid
};

struct SolveReport {
  int iterations = 0;
  double residual = 0;  ///< |b - A x| / |b| at the end, in that norm
  bool converged = false;
};

/// Solves A x = b by preconditioned conjugate gradients.
///
/// With the default parameters of the method the systems are dominated by their diagonal and
/// Jacobi does in 10 to 30 iterations. Where it does not (large beta, fine cells), aggregation
/// multigrid takes over from where Jacobi stopped; its count hardly depends on beta.
///
/// @param b  right-hand side.
/// @param x  in: the first guess; out: the solution. A zero b gives a zero x.
/// @return not converged is not an error: the caller reports it.
SolveReport solve(const SpdOperator& a, std::span<const double> b, std::span<double> x,
                  const SolveOptions& options = {});

}  // namespace mesamis
