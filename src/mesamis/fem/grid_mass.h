// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "mesamis/base/types.h"
#include "mesamis/fem/grid_space.h"

namespace mesamis::detail::fem {

/// The lumped masses of a Kuhn grid's nodes, by formula instead of one number per node: they depend
/// only on which sides of the box a node lies, see P1Space::lumped_mass().
class GridMass {
 public:
  /// Those of the nodes of a line along the first axis.
  struct Row {
    double first, inside, last;
    Index length;
    /// Of node i of the line.
    /// @return in the cube of the unit of the spacing.
    double at(Index i) const noexcept { return i == 0 ? first : i + 1 == length ? last : inside; }
  };

  /// Finds the 27 masses.
  /// @param grid  at least two nodes along each axis.
  explicit GridMass(const KuhnGrid& grid) : size_(grid.size), quarter_(grid.cell_volume() / 4) {
    for (std::size_t side = 0; side < masses_.size(); ++side) masses_[side] = of_side(side);
  }

  /// Of the line of nodes (., j, k), in the cube of the spacing's unit.
  Row row(Index j, Index k) const noexcept {
    const std::size_t across = 3 * side_of(j, size_[1]) + 9 * side_of(k, size_[2]);
    return {masses_[across], masses_[across + 1], masses_[across + 2], size_[0]};
  }

  /// Of node n. O(1), two divisions.
  /// @return in the cube of the unit of the spacing.
  double at(std::size_t n) const noexcept {
    const auto [i, j, k] = grid_place(size_, static_cast<unsigned>(n));
    return masses_[side_of(i, size_[0]) + 3 * side_of(j, size_[1]) + 9 * side_of(k, size_[2])];
  }

 private:
  /// 0: the first node of its line, 1: inside, 2: the last.
  static std::size_t side_of(Index i, Index count) noexcept {
    return i == 0 ? 0 : i + 1 == count ? 2 : 1;
  }

  /// A quarter of the cells around: six of a brick whose main diagonal ends here, else two.
  double of_side(std::size_t side) const noexcept {
    const std::array<std::size_t, 3> sides{side % 3, side / 3 % 3, side / 9};
    int cells = 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {  // of the brick, where the node is
      bool exists = true;
      for (std::size_t a = 0; a < 3; ++a) {
        exists &= sides[a] != ((corner >> a & 1) != 0 ? 0u : 2u);
      }
      if (exists) cells += corner == 0 || corner == 7 ? 6 : 2;
    }
    return quarter_ * cells;
  }

  std::array<Index, 3> size_;
  double quarter_;  // of a cell's volume
  std::array<double, 27> masses_{};
};

}  // namespace mesamis::detail::fem
