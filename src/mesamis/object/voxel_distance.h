// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// Distances between voxel centres, and what grows and shrinks by them.
namespace mesamis::detail::object {

/// A mark per voxel, i fastest: 0 is outside, anything else inside. What mask_on() returns.
using VoxelMask = std::vector<std::uint8_t>;

/// Checks that a mask has one mark per voxel of a grid.
/// @throws InputError  naming both numbers.
void require_mask_of(std::span<const std::uint8_t> mask, const VoxelGrid& grid);

/// Measures the Euclidean distance from each voxel centre to the nearest one of a mask, exactly up
/// to rounding. One axis after the other: the least of parabolas along each line. Source:
/// Felzenszwalb, Huttenlocher, Distance transforms of sampled functions, Theory of Computing 8,
/// 2012.
/// @param mask  one mark per voxel of the grid.
/// @return mm per voxel; 0 in the mask; infinite everywhere if the mask is empty. Nothing beyond
///         the grid counts.
/// @throws InputError  if the mask does not fit the grid.
///
/// O(voxels), in threads; 4 bytes per voxel. The same bits for any number of threads.
std::vector<float> distance_to_mask(std::span<const std::uint8_t> mask, const VoxelGrid& grid);

/// Grows a mask by all voxels whose centre is within a distance of one of its own.
/// @param mm  >= 0, to a millionth part; 0 changes nothing.
/// @return 1 inside, 0 outside.
/// @throws InputError  if the mask does not fit the grid, or mm is negative or not a number.
///
/// O(voxels), in threads.
VoxelMask dilated(std::span<const std::uint8_t> mask, const VoxelGrid& grid, double mm);

/// Shrinks a mask to the centres of the balls that fit into it; what is beyond the grid counts as
/// within it.
/// @param mm  radius of the balls, as for dilated().
/// @return 1 inside, 0 outside.
/// @throws InputError  as dilated(). Cost as there.
VoxelMask eroded(std::span<const std::uint8_t> mask, const VoxelGrid& grid, double mm);

/// Swaps inside and outside.
/// @return 1 inside, 0 outside.
VoxelMask complement(std::span<const std::uint8_t> mask);

/// Keeps the marks of one mask that another lacks.
/// @param other  as many marks.
/// @return 1 inside, 0 outside.
VoxelMask only_in(std::span<const std::uint8_t> mask, std::span<const std::uint8_t> other);

/// Counts the marked voxels.
std::size_t count_marked(std::span<const std::uint8_t> mask);

}  // namespace mesamis::detail::object
