// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/object/voxel_distance.h"

/// Islands of marked voxels: those that a way through faces of voxels connects. Cavities are what
/// they enclose.
namespace mesamis::detail::object {

/// The islands of a mask. They are numbered from 1 in the order of their first voxels.
struct VoxelIslands {
  std::vector<Index> of_voxel;      ///< per voxel the number of its island; 0 outside of the mask
  std::vector<std::size_t> voxels;  ///< of each island; island n is at n - 1

  /// The number of the island with most voxels, the first of those; 0 if there is none.
  Index largest() const noexcept;
};

/// Finds the islands of a mask.
/// @param mask  one mark per voxel of the grid.
/// @throws InputError  if the mask does not fit the grid.
///
/// O(voxels); 4 bytes per voxel.
VoxelIslands find_islands(std::span<const std::uint8_t> mask, const VoxelGrid& grid);

/// Finds the smallest range of voxels that holds each island.
/// @param islands  of the grid.
/// @return one per island; island n is at n - 1.
std::vector<CropRange> ranges_of(const VoxelIslands& islands, const VoxelGrid& grid);

/// Marks the voxels of one island.
/// @param island  from 1 to the number of islands.
/// @return 1 inside, 0 outside.
VoxelMask mask_of_island(const VoxelIslands& islands, Index island);

/// Finds the marked voxel nearest to a voxel.
/// @param from     within the grid.
/// @param most_mm  no further than this between the centres, mm, 0 to 100.
/// @return its place among the samples, of several as near the first; nothing if there is none.
/// @throws InputError  if the mask does not fit the grid.
///
/// O(voxels within that distance).
std::optional<std::size_t> find_marked(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                                       const std::array<Index, 3>& from, double most_mm);

/// A place may be this far beside the object that is meant, mm: as far as one points beside it.
inline constexpr double kBesideMm = 3;

/// Finds the marked voxels that a place stands for: the nearest one within kBesideMm, or within a
/// voxel where those are larger; where there is none, or only a crumb of which a tenfold island
/// encloses the place, those of that island that enclose it, as bone does the spongy inside of a
/// vertebra. Voxels enclose it that are met within 30 mm on half of the 26 ways along axes and
/// diagonals, and on three quarters of those that do not leave the grid; those more than 1.5 times
/// as far as the median, and those of islands smaller than the largest, are left out.
/// @param at  within the grid, see voxel_at().
/// @return places among the samples, the nearest first; empty if there are none.
/// @throws InputError  if the mask does not fit the grid.
///
/// O(voxels); 4 bytes per voxel.
std::vector<std::size_t> find_marked_at(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                                        const std::array<Index, 3>& at);

/// Whether there are some. O(voxels within kBesideMm and on the ways).
bool has_marked_at(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                   const std::array<Index, 3>& at);

/// The same where there must be some.
/// @param at  within the grid. Cost as there.
/// @return places among the samples, at least one, the nearest first.
/// @throws InputError  if there are none, or the mask does not fit the grid.
std::vector<std::size_t> marked_at(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                                   const std::array<Index, 3>& at);

/// Marks the island that a place belongs to: that of the first of the marked voxels that it stands
/// for.
/// @param mask  of the object and others: mask_on(), or mask_above() of a level.
/// @param at    within the grid, see voxel_at().
/// @return 1 inside, 0 outside.
/// @throws InputError  as marked_at().
VoxelMask island_at(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                    const std::array<Index, 3>& at);

/// Fills the cavities of a mask: unmarked voxels that no way through faces of unmarked voxels
/// connects with the border of the grid.
/// @return 1 inside, 0 outside.
/// @throws InputError  if the mask does not fit the grid.
///
/// O(voxels); 5 bytes per voxel.
VoxelMask without_cavities(std::span<const std::uint8_t> mask, const VoxelGrid& grid);

/// Fills the cavities of each slice by itself: also what opens beyond the slice, as the airways do.
/// @param axis  0 to 2: across the slices.
/// @return 1 inside, 0 outside.
/// @throws InputError  if the mask does not fit the grid.
///
/// O(voxels), in threads; a few bytes per voxel of the slices in work.
VoxelMask without_cavities_in_slices(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                                     int axis);

/// Marks the samples above a level.
/// @param level  native units.
/// @return 1 above, 0 elsewhere.
VoxelMask mask_above(const VolumeView& volume, double level);

}  // namespace mesamis::detail::object
