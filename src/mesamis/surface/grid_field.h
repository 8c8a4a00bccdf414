// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/mesh/kuhn.h"
#include "mesamis/surface/grid_partition.h"
#include "mesamis/surface/partition_cells.h"

namespace mesamis::detail::surface {

/// @throws InputError  if the sizes do not fit, a material or a label is out of range, or a value
///                     is not finite.
void require_memberships(const GridMemberships& grid);

/// Names the sides of triangles by the labels of their materials, and turns a triangle where the
/// order of the labels is not that of the materials. Names sites by the nodes of the whole grid.
PartitionPart named_wholly(const GridMemberships& grid, JoinedBlocks blocks);

/// @throws InputError  if slices do not follow each other, or the grid has not those beside them,
///                     as far as the larger grid has any.
/// @param below, above  how many slices beside those of the range are needed.
void require_slices(const GridMemberships& grid, const NodeSlices& slices, Index below,
                    Index above);

/// A field of partition_cells.h: memberships on a grid.
class GridField {
 public:
  GridField(const GridMemberships& grid, bool close_at_box)
      : grid_(grid),
        close_at_box_(close_at_box),
        stride_{1, grid.size[0], grid.size[0] * grid.size[1]} {}

  std::array<Index, 3> place(Index node) const { return grid_place(grid_.size, node); }
  Vec3 point(Index node) const {
    const auto [i, j, k] = place(node);
    return {i * grid_.spacing.x, j * grid_.spacing.y, (k + grid_.below) * grid_.spacing.z};
  }
  Index material(Index node) const { return grid_.material[static_cast<std::size_t>(node)]; }
  double membership(Index node, Index material) const {
    const auto n = static_cast<std::size_t>(node);
    for (auto i = static_cast<std::size_t>(grid_.first[n]);
         i < static_cast<std::size_t>(grid_.first[n + 1]); ++i) {
      if (grid_.listed[i] == material) return grid_.value[i];
    }
    return 0;
  }
  unsigned planes(Index node) const {
    if (!close_at_box_) return 0;
    const auto [i, j, k] = place(node);
    return unsigned{i == 0} | unsigned{i + 1 == grid_.size[0]} << 1U | unsigned{j == 0} << 2U |
           unsigned{j + 1 == grid_.size[1]} << 3U | unsigned{is_bottom(k)} << 4U |
           unsigned{is_top(k)} << 5U;
  }

  /// Whether a cube, named by its lowest node, has one material.
  bool is_uniform(Index cube) const {
    for (const auto& [i, j, k] : kKuhnSteps) {
      if (material(cube + i + j * stride_[1] + k * stride_[2]) != material(cube)) return false;
    }
    return true;
  }

  /// Calls visit(cube) for the cubes above layer k that have boundaries in them, or caps on them.
  template <class Visit>
  void for_cubes_above(Index k, Visit visit) const {
    if (k + 1 == grid_.size[2]) return;
    for (Index j = 0; j + 1 < grid_.size[1]; ++j) {
      const bool at_end = is_bottom(k) || is_top(k + 1) || j == 0 || j + 2 == grid_.size[1];
      for (Index i = 0; i + 1 < grid_.size[0]; ++i) {
        const Index cube = i + j * stride_[1] + k * stride_[2];
        const bool at_box = close_at_box_ && (at_end || i == 0 || i + 2 == grid_.size[0]);
        if (at_box || !is_uniform(cube)) visit(cube);
      }
    }
  }

  /// Calls visit(cell) for the Kuhn tetrahedra of a cube.
  template <class Visit>
  void for_cells(Index cube, Visit visit) const {
    for (const auto& path : kKuhnPaths) visit(kuhn_cell(cube, stride_, path));
  }

  /// Those of the cubes that for_cubes_above() visits.
  template <class Visit>
  void for_cells_above(Index k, Visit visit) const {
    for_cubes_above(k, [&](Index cube) { for_cells(cube, visit); });
  }

 private:
  bool is_bottom(Index k) const { return k == 0 && grid_.below == 0; }
  bool is_top(Index k) const { return k + 1 == grid_.size[2] && grid_.above == 0; }

  const GridMemberships& grid_;
  bool close_at_box_;
  std::array<Index, 3> stride_;
};

}  // namespace mesamis::detail::surface
