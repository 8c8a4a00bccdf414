// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::labels {

/// A block of voxels of a grid; it may reach beyond it.
struct LabelBlock {
  std::array<Index, 3> begin{}, size{};  ///< voxels
};

/// Finds the block around segments of a label map.
/// @param chosen  of the map.
/// @param room    mm, >= 0, left to all sides, and four voxels more.
/// @return at least 2 voxels along each axis; nothing if no chosen segment has a voxel.
///
/// O(voxels * layers + segments * chosen).
std::optional<LabelBlock> block_around(const LabelMap& map, std::span<const Segment> chosen,
                                       double room);

/// Finds the block around voxels of a grid.
/// @param range  of the grid, at least one voxel.
/// @param room   as above.
LabelBlock block_around(const VoxelGrid& grid, const CropRange& range, double room);

/// What of a block lies within a grid, but at least 2 voxels along each axis where the grid has so
/// many.
LabelBlock clipped(const LabelBlock& block, const VoxelGrid& grid);

/// The grid of a block: where its voxels lie in the world.
VoxelGrid grid_of(const VoxelGrid& grid, const LabelBlock& block);

/// The labels of a layer in a block, background beyond the map.
/// @return one per voxel of the block; i runs fastest.
std::vector<std::uint16_t> labels_in(const LabelMap& map, Index layer, const LabelBlock& block);

/// Makes labels that nobody chose background, as if the map had only the others.
/// @param chosen  of each label 1 if it is chosen.
void keep_chosen(std::span<const char> chosen, std::vector<std::uint16_t>& labels);

}  // namespace mesamis::detail::labels
