// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/p1_space.h"

namespace mesamis::detail::fem {

/// A regular grid of nodes whose bricks are cut into Kuhn tetrahedra, none of them stored.
struct KuhnGrid {
  std::array<Index, 3> size{0, 0, 0};  ///< nodes per direction, at least 2
  Vec3 spacing;                        ///< between nodes

  /// The number of nodes.
  std::size_t node_count() const noexcept {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  /// The number of tetrahedra: six per brick.
  std::int64_t cell_count() const noexcept {
    return 6 * std::int64_t{size[0] - 1} * (size[1] - 1) * (size[2] - 1);
  }
  /// The volume of each tetrahedron, in the cube of the unit of the spacing.
  double cell_volume() const noexcept { return spacing.x * spacing.y * spacing.z / 6; }
  /// The steps between the numbers of neighbouring nodes along each axis.
  std::array<std::size_t, 3> stride() const noexcept {
    return {1, static_cast<std::size_t>(size[0]),
            static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])};
  }
  /// The box from the first node to the last, in the unit of the spacing.
  Box box() const noexcept {
    return {{0, 0, 0},
            {(size[0] - 1) * spacing.x, (size[1] - 1) * spacing.y, (size[2] - 1) * spacing.z}};
  }
};

/// P1 functions on a Kuhn grid. The gradients of a Kuhn cell are differences along its three
/// axis-parallel edges, so the stiffness matrix couples a node to its six axis neighbours only:
/// a 7-point stencil with one conductance per axis edge, and an M-matrix.
class GridSpace : public P1Space {
 public:
  /// Computes the lumped mass.
  /// @param grid  n nodes.
  /// @throws InputError  for fewer than two nodes along an axis.
  explicit GridSpace(const KuhnGrid& grid);

  /// The grid.
  const KuhnGrid& grid() const noexcept { return grid_; }

  const std::vector<double>& lumped_mass() const override { return lumped_mass_; }
  std::unique_ptr<SpdOperator> diffusion(std::span<const double> w, double scale, double offset,
                                         std::vector<double> diagonal) const override;
  std::vector<double> gradient_squares(std::span<const double> u) const override;

 private:
  KuhnGrid grid_;
  std::vector<double> lumped_mass_;
};

}  // namespace mesamis::detail::fem
