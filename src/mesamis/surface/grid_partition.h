// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/surface/partition_part.h"

namespace mesamis::detail::surface {

/// Memberships of many materials at the nodes of a regular grid, kept only where they decide: at
/// each node those of its own material and of its neighbours' materials. The neighbours of a node
/// are the 14 with which it shares an edge of the grid's Kuhn tetrahedra, see kuhn.h. The nodes may
/// be some slices of a larger grid.
struct GridMemberships {
  std::array<Index, 3> size{};  ///< nodes along i, j, k; at least 2 each
  Vec3 spacing{1, 1, 1};        ///< between nodes, mm, > 0
  std::vector<Index> material;  ///< of each node, the one that wins there; i runs fastest
  std::vector<Index> label;     ///< of each material, the object that it is part of, >= 0

  /// Node n has the memberships value[i] of the materials listed[i], i from first[n] to before
  /// first[n + 1]; a material that is not listed has the membership 0. In any unit, finite.
  std::vector<std::int64_t> first;
  std::vector<Index> listed;
  std::vector<float> value;

  Index below = 0, above = 0;  ///< slices of the larger grid below and above; else 0
};

/// Extracts the boundaries between objects as extract_partition() does, on the grid's Kuhn
/// tetrahedra. Neighbouring nodes whose materials differ belong to objects that differ.
/// @param memberships  of a whole grid.
/// @return points in mm, the first node at the origin; its sides are labels.
/// @throws InputError  if the sizes do not fit, a material or a label is out of range, or a value
///                     is not finite.
///
/// O(nodes + s log s) for s triangles: cubes of one material are passed over. The same bits for any
/// number of threads.
PartitionSurface extract_partition_on_grid(const GridMemberships& memberships,
                                           const PartitionOptions& options = {});

/// The same of the cubes above some slices: open where it goes on.
/// @param memberships  of some slices of a larger grid: with one above those, as far as there is
///                     one.
PartitionPart extract_partition_part(const GridMemberships& memberships, const NodeSlices& slices,
                                     const PartitionOptions& options = {});

}  // namespace mesamis::detail::surface
