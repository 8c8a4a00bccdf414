// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "mesamis/surface/grid_partition.h"

namespace mesamis::detail::surface {

/// A label at each node of a regular grid: at the centres of voxels.
struct LabelGrid {
  std::array<Index, 3> size{};              ///< nodes along i, j, k; at least 2 each
  Vec3 spacing{1, 1, 1};                    ///< between nodes, mm, > 0
  std::span<const std::uint16_t> labels{};  ///< i runs fastest, then j, k

  /// As many nodes as the size has.
  std::size_t node_count() const noexcept {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
};

/// How smooth_memberships() smooths.
struct SmoothOptions {
  double sigma_voxel = 1.5;        ///< of the Gaussian, nodes, along each axis; 0.5 to 4
  double volume_accuracy = 0.002;  ///< relative, of each part, no unit; > 0
  int most_rounds = 12;            ///< to match the volumes; 0: they are only measured
};

/// What smooth_memberships() reached.
struct SmoothReport {
  Index parts = 0;          ///< connected parts of all labels, of the background too
  int rounds = 0;           ///< to match the volumes
  double volume_error = 0;  ///< relative, no unit: the worst of all parts
  bool converged = false;   ///< the volumes match
};

/// How many nodes away the parts of labels matter to a membership before volumes are matched.
Index smoothing_reach(const SmoothOptions& options);

/// Makes memberships of labels, whose boundaries are smooth between the voxels.
///
/// Each part of a label that is connected along edges of the Kuhn tetrahedra becomes a material.
/// Its membership is 2 G p - G G p for its indicator p and a Gaussian G: that filter has no second
/// moment, so that curved boundaries hardly shrink. Then
///  - at every node the label of the node wins, so that no part is lost, and none joins another.
///    Only single steps of stairs yield to the neighbouring part, where this changes the topology
///    of neither and leaves nothing one node thick;
///  - where a part is one node thick, it is raised so that it stays about as thick;
///  - to each material a constant is added, such that the volume of each part is that of its voxels
///    (those at the faces of the grid count as far as they lie within it).
///
/// @param grid    as many labels as nodes. Label 0 is treated like any other.
/// @param report  optional.
/// @return one material per part; for extract_partition_on_grid().
/// @throws InputError  if the sizes do not fit or an option is out of range.
///
/// O(nodes): about 20 bytes per node, and per node at a boundary and part near it 12 more. The same
/// bits for any number of threads.
GridMemberships smooth_memberships(const LabelGrid& grid, const SmoothOptions& options = {},
                                   SmoothReport* report = nullptr);

}  // namespace mesamis::detail::surface
