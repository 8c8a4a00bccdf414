// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/spd_operator.h"

namespace mesamis {

/// Continuous piecewise linear functions on a tetrahedral mesh, with what the functional needs
/// of them. A function is its vector of n nodal values; lengths are in the mesh's own unit.
///
/// Two meshes have one: any TetMesh (MeshSpace) and the voxel grid cut into Kuhn tetrahedra,
/// whose cells are known by formula and never stored (GridSpace).
class P1Space {
 public:
  virtual ~P1Space() = default;

  std::size_t node_count() const { return lumped_mass().size(); }

  /// m_n = sum of |K|/4 over the cells around node n: the weights of P_h-integrals.
  virtual const std::vector<double>& lumped_mass() const = 0;

  /// The operator diag(d) + K(c), with K(c)_ij = sum_K c_K |K| grad phi_i . grad phi_j and the
  /// cell coefficient c_K = scale * (mean of w over the four nodes of K) + offset.
  ///
  /// @param w         n nodal weights, or empty: then c_K = offset.
  /// @param diagonal  d, n positive values.
  virtual std::unique_ptr<SpdOperator> diffusion(std::span<const double> w, double scale,
                                                 double offset,
                                                 std::vector<double> diagonal) const = 0;

  /// s_n = sum of |K|/4 |grad u|_K^2 over the cells around node n.
  virtual std::vector<double> gradient_squares(std::span<const double> u) const = 0;
};

}  // namespace mesamis
