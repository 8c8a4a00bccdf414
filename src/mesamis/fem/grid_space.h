// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/p1_space.h"

namespace mesamis {

/// A regular grid of nodes whose bricks are cut into Kuhn tetrahedra, none of them stored.
struct KuhnGrid {
  std::array<Index, 3> size{0, 0, 0};  ///< nodes per direction, at least 2
  Vec3 spacing;                        ///< between nodes

  std::size_t node_count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  std::int64_t cell_count() const {
    return 6 * std::int64_t{size[0] - 1} * (size[1] - 1) * (size[2] - 1);
  }
  std::array<std::size_t, 3> stride() const {
    return {1, static_cast<std::size_t>(size[0]),
            static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])};
  }
  Box box() const {
    return {{0, 0, 0},
            {(size[0] - 1) * spacing.x, (size[1] - 1) * spacing.y, (size[2] - 1) * spacing.z}};
  }
};

/// P1 functions on a Kuhn grid. The gradients of a Kuhn cell are differences along its three
/// axis-parallel edges, so the stiffness matrix couples a node to its six axis neighbours only:
/// a 7-point stencil with one conductance per axis edge, and an M-matrix.
class GridSpace : public P1Space {
 public:
  explicit GridSpace(const KuhnGrid& grid);

  const std::vector<double>& lumped_mass() const override { return lumped_mass_; }
  std::unique_ptr<SpdOperator> diffusion(std::span<const double> w, double scale, double offset,
                                         std::vector<double> diagonal) const override;
  std::vector<double> gradient_squares(std::span<const double> u) const override;

 private:
  KuhnGrid grid_;
  std::vector<double> lumped_mass_;
};

}  // namespace mesamis
