// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/fem/amis.h"
#include "mesamis/fem/grid_space.h"

namespace mesamis::detail::fem {

/// The least relative residual for which single precision is used.
inline constexpr double kLeastSingleTolerance = 1e-4;

/// The minimisers on a grid, one value per node each, in single precision.
struct GridMinimum {
  std::vector<float> u;  ///< denoised image, grey values
  std::vector<float> v;  ///< edge indicator: 0 at edges, 1 away from them
  AmisReport report;
  Energy energy;  ///< of u and v
};

/// Algorithm 1 on a Kuhn grid, from u = f and v = 1: run_amis(), in single precision and in half of
/// the memory. Systems that single precision is too coarse for (a tolerance below
/// kLeastSingleTolerance), or whose
/// conjugate gradients need more than options.solver.jacobi_iterations, are left to run_amis().
///
/// @param grid  n nodes, at least two along each axis.
/// @param f     n grey values.
/// @throws InputError  as run_amis().
///
/// O(n); 44 bytes per node, the minimisers included. The same bits for any number of threads.
GridMinimum run_amis_on_grid(const KuhnGrid& grid, std::span<const float> f,
                             const AmisOptions& options);

}  // namespace mesamis::detail::fem
