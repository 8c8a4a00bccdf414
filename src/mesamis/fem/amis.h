// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesamis/fem/functional.h"
#include "mesamis/fem/p1_space.h"
#include "mesamis/fem/solve.h"

namespace mesamis::detail::fem {

/// When the minimisation ends, and how its systems are solved.
struct AmisOptions {
  AtParameters parameters;
  int max_iterations = 10;    ///< Jmax, at least 1
  double v_tolerance = 1e-2;  ///< F: stop when v changes less than this anywhere
  SolveOptions solver;
  /// Optional; called after each half step with the current fields.
  std::function<void(std::span<const double> u, std::span<const double> v)> after_half_step;
};

/// How the minimisation went.
struct AmisReport {
  int iterations = 0;
  double v_change = 0;           ///< largest change of v in the last iteration
  bool converged = false;        ///< v_change <= v_tolerance
  std::size_t clamped = 0;       ///< nodal values of v that left [0, 1] and were clamped, in all
  int solver_iterations = 0;     ///< conjugate gradient steps, in all
  double solver_residual = 0;    ///< largest relative residual of any solve
  double solver_tolerance = 0;   ///< required relative residual
  bool solver_converged = true;  ///< every solve reached the tolerance
};

/// Where the minimisation starts.
struct AmisStart {
  /// First edge indicator, n values in [0, 1], or empty: 1 everywhere. Taken over.
  std::vector<double> v = {};
  /// First guess of u, n grey values (e.g. carried from the last mesh), or empty: f.
  std::span<const double> u = {};
};

/// The minimisers, one value per node each, and how they were found.
struct AmisResult {
  std::vector<double> u;  ///< denoised image, grey values
  std::vector<double> v;  ///< edge indicator: 0 at edges, 1 away from them
  AmisReport report;
};

/// Minimises the functional in turn over u (v fixed) and v (u fixed). Source: Algorithm 1.
///
/// u-step: lumped mass + stiffness with cell coefficient beta (mean v^2 + eta), right-hand side
/// lumped mass times f. v-step: stiffness gamma eps + a diagonal, right-hand side gamma / (4 eps)
/// lumped mass. Each step minimises a convex quadratic, so the energy never rises. v stays in
/// [0, 1] (Prop. 2.1); where obtuse cells break that, it is clamped and the report counts it.
///
/// @param space  n nodes.
/// @param f      projected image, n grey values.
/// @throws InputError  for sizes that differ or a parameter out of range, naming the range.
/// @return reaching an iteration limit is no error: the report says so.
/// One sparse system per half step, O(n) memory each. The same bits for any number of threads.
AmisResult run_amis(const P1Space& space, std::span<const double> f, AmisStart start,
                    const AmisOptions& options);

}  // namespace mesamis::detail::fem
