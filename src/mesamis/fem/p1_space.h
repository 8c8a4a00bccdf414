// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/spd_operator.h"

namespace mesamis::detail::fem {

/// Continuous piecewise linear functions on a tetrahedral mesh, and the matrices and integrals that
/// the functional (2) needs. A function is its vector of n nodal values; lengths are in the mesh's
/// own unit.
///
/// There are two: on any TetMesh (MeshSpace) and on the voxel grid cut into Kuhn tetrahedra,
/// whose cells are known by formula and never stored (GridSpace).
class P1Space {
 public:
  virtual ~P1Space() = default;

  /// The number of nodes n.
  std::size_t node_count() const { return lumped_mass().size(); }

  /// The lumped mass, m_n = sum of |K|/4 over the cells around node n: n weights of the integrals
  /// of P_h, in the cube of the unit of length of the mesh.
  virtual const std::vector<double>& lumped_mass() const = 0;

  /// Makes the operator diag(d) + K(c), with K(c)_ij = sum_K c_K |K| grad phi_i . grad phi_j and
  /// the cell coefficient c_K = scale * (mean of w over the four nodes of K) + offset.
  ///
  /// @param w              n nodal weights of any unit, or empty: then c_K = offset.
  /// @param scale, offset  such that no c_K is negative; offset in the unit of scale times w.
  /// @param diagonal       d, n positive values, in the unit of c times a length.
  /// @return n unknowns; it does not refer to the arguments.
  ///
  /// O(n + m) for m cells.
  virtual std::unique_ptr<SpdOperator> diffusion(std::span<const double> w, double scale,
                                                 double offset,
                                                 std::vector<double> diagonal) const = 0;

  /// Computes s_n = sum of |K|/4 |grad u|_K^2 over the cells around node n.
  /// @param u  n values of any unit.
  /// @return n values, in the unit of u squared times the unit of length of the mesh.
  ///
  /// O(n + m) for m cells.
  virtual std::vector<double> gradient_squares(std::span<const double> u) const = 0;
};

}  // namespace mesamis::detail::fem
