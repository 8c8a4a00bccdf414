// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "mesamis/fem/grid_mass.h"
#include "mesamis/fem/solve.h"

namespace mesamis::detail::fem {

/// The systems diag(d) + K(c) of a Kuhn grid (GridSpace::diffusion()) in single precision: with
/// half of the bytes they take half of the memory and of the time. Sums over the grid are in double
/// precision. One object serves one system after the other in the same memory.
class SingleGridSystem {
 public:
  /// Reserves the memory: 28 bytes per node.
  /// @param grid  at least two nodes along each axis.
  explicit SingleGridSystem(const KuhnGrid& grid);

  /// d: to be set, n positive values, in the unit of c times a length, before solve() is called.
  std::vector<float>& diagonal() noexcept { return diagonal_; }
  /// b: to be set, n values in the unit of d times that of x, before solve() is called, which
  /// changes them.
  std::vector<float>& right() noexcept { return r_; }

  /// Adds K(c) with the cell coefficient c_K = scale * (mean of v^2 over the nodes of K) + offset.
  /// @param v  n values of any unit, or empty: then c_K = offset.
  /// @param scale, offset  such that no c_K is negative; offset in the unit of scale times v^2.
  void couple(std::span<const float> v, double scale, double offset);

  /// Solves the system by conjugate gradients with the Jacobi preconditioner.
  /// @param x  in: the first guess, n values of any unit; out: the solution.
  /// @param options  of max_iterations and jacobi_iterations the smaller counts.
  /// @return the residual is that of the recurrence, which round-off may part from the true one by
  ///         about 1e-6.
  ///
  /// O(n) per iteration. The same bits for any number of threads.
  SolveReport solve(std::span<float> x, const SolveOptions& options);

 private:
  void add_cell_coefficients(std::span<const float> v, double scale, double offset);
  void find_diagonal(std::size_t n, Index j, Index k, std::span<float> line) const;
  template <class Body>
  double sum_with_diagonal(Body&& body) const;
  double apply(std::span<const float> x);
  double start();
  double step(std::span<float> x, double alpha);
  void turn(double beta);

  KuhnGrid grid_;
  std::array<std::vector<float>, 3> conductance_;  // of the edge from n to its next node
  std::vector<float> diagonal_, r_, p_, ap_;
};

/// Computes P1Space::gradient_squares() on a grid in single precision.
/// @param u        n values of any unit.
/// @param squares  n values, overwritten; in the square of that unit times the grid's.
///
/// O(n), in threads; the same bits for any number of them.
void find_gradient_squares(const KuhnGrid& grid, std::span<const float> u,
                           std::span<float> squares);

/// Adds up term(n, mass of n) over the nodes of a grid, line by line.
/// @return in the unit of the terms.
///
/// O(n), in threads; the same bits for any number of them.
double sum_over_nodes(const KuhnGrid& grid, const GridMass& mass,
                      const std::function<double(std::size_t, double)>& term);

}  // namespace mesamis::detail::fem
