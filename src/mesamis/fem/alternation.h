// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/amis.h"

/// What the half steps of Algorithm 1 share, in double and in single precision.
namespace mesamis::detail::fem {

/// @throws InputError  if a field has not one value per node.
inline void require_size(const char* name, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  throw InputError(std::string("amis: ") + name + " has " + std::to_string(found) + " values for " +
                   std::to_string(expected) + " nodes");
}

/// Adds one solve to the report.
inline void record(const SolveReport& solved, AmisReport& report) {
  report.solver_iterations += solved.iterations;
  report.solver_residual = std::max(report.solver_residual, solved.residual);
  report.solver_converged &= solved.converged;
}

/// Prop. 2.1 holds on Kuhn grids; obtuse cells can break it by a little. What is within the
/// solver's accuracy of the interval is not counted.
/// @return how many values left [0, 1].
template <class Real>
std::size_t clamp_v(std::vector<Real>& v, double solver_tolerance) {
  const double slack = 10 * solver_tolerance;
  std::size_t clamped = 0;
  for (Real& value : v) {
    clamped += value < -slack || value > 1 + slack;
    value = std::clamp(value, Real{0}, Real{1});
  }
  return clamped;
}

/// The largest difference between two fields of one size.
template <class Real>
double largest_change(const std::vector<Real>& a, const std::vector<Real>& b) {
  return parallel_max(a.size(), 0, [&](std::size_t begin, std::size_t end) {
    Real largest = 0;
    for (std::size_t n = begin; n < end; ++n) largest = std::max(largest, std::abs(a[n] - b[n]));
    return double{largest};
  });
}

}  // namespace mesamis::detail::fem
