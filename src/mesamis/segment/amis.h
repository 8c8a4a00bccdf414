// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesamis/fem/p1_space.h"
#include "mesamis/fem/solve.h"
#include "mesamis/segment/functional.h"

namespace mesamis {

struct AmisOptions {
  AtParameters parameters;
  int max_iterations = 10;    ///< Jmax, at least 1
  double v_tolerance = 1e-2;  ///< F: stop when v changes less than this anywhere
  SolveOptions solver;
  /// Called after each half step with the current fields, for those who want to watch.
  std::function<void(std::span<const double> u, std::span<const double> v)> after_half_step;
};

struct AmisReport {
  int iterations = 0;
  double v_change = 0;          ///< largest change of v in the last iteration
  bool converged = false;       ///< v_change <= v_tolerance
  std::size_t clamped = 0;      ///< nodal values of v that left [0, 1] and were clamped, in all
  int solver_iterations = 0;    ///< conjugate gradient steps, in all
  double solver_residual = 0;   ///< largest relative residual of any solve
  double solver_tolerance = 0;  ///< what was asked of it
  bool solver_converged = true;
};

struct AmisFields {
  std::vector<double> u;  ///< denoised image, grey values
  std::vector<double> v;  ///< edge indicator: 0 at edges, 1 away from them
};

/// Minimises the functional in turn over u (v fixed) and v (u fixed). Source: Algorithm 1.
///
/// u-step: lumped mass + stiffness with cell coefficient beta (mean v^2 + eta), right-hand side
/// lumped mass times f. v-step: stiffness gamma eps + a diagonal, right-hand side gamma / (4 eps)
/// lumped mass. Each step minimises a convex quadratic, so the energy never rises.
///
/// @param f   projected image, one grey value per node.
/// @param v0  first edge indicator, one per node; 1 everywhere if nothing is known.
/// @param u0  first guess of the u-solver (e.g. carried from the last mesh), or empty: f.
/// @throws InputError  for sizes that differ or a parameter out of range, naming the range.
AmisFields run_amis(const P1Space& space, std::span<const double> f, std::vector<double> v0,
                    std::span<const double> u0, const AmisOptions& options,
                    AmisReport* report = nullptr);

/// @throws InputError  naming the parameter, its range and the value found.
void require_valid(const AtParameters& parameters);

}  // namespace mesamis
