// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/spd_operator.h"

namespace mesamis::detail::fem {

/// Aggregation multigrid as a preconditioner: groups of about eight unknowns are one unknown of
/// the next level, the coarse operator is the Galerkin one, the smoother is l1-Jacobi (which
/// converges for every SPD matrix), the cycle is W. Symmetric positive definite itself.
/// Sources: Notay, An aggregation-based algebraic multigrid method, ETNA 37, 2010;
/// Baker, Falgout, Kolev, Yang, Multigrid smoothers for ultraparallel computing, SISC 33, 2011.
class Multigrid {
 public:
  /// Builds the levels.
  /// @param a  n unknowns. The preconditioner refers to it: it must live longer.
  explicit Multigrid(const SpdOperator& a);
  ~Multigrid();

  /// z = B r, one cycle from zero. Works in memory of the levels: not for two threads at
  /// once.
  void apply(std::span<const double> r, std::span<double> z) const;

 private:
  struct Level;
  void cycle(std::size_t level, std::span<const double> r, std::span<double> z) const;
  std::vector<std::unique_ptr<Level>> levels_;
};

}  // namespace mesamis::detail::fem
