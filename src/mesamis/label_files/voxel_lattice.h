// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// Grids whose voxels coincide, though they begin and end elsewhere or their axes run elsewhere:
/// cut out of one another, mirrored, turned by right angles.
namespace mesamis::detail::label_files {

/// Where the voxels of a grid lie among those of another one.
struct LatticePlace {
  std::array<std::int64_t, 3> first{};                 ///< voxel (0, 0, 0)
  std::array<std::array<std::int64_t, 3>, 3> steps{};  ///< along each axis: 1 or -1 of one axis

  /// The voxel of the other grid.
  std::array<std::int64_t, 3> at(const std::array<Index, 3>& voxel) const noexcept;
};

/// Finds that place; none unless all voxel centres coincide to 1e-3 of a voxel.
/// @throws nothing
std::optional<LatticePlace> find_place(const VoxelGrid& grid, const VoxelGrid& other);

/// Finds the least grid along the axes of the first one that holds the voxels of all.
/// @param files  whose grids these are, for messages.
/// @param grids  as many, at least one.
/// @throws InputError  naming the file whose voxels do not coincide with those of the first, and
///                     if the grid would have more than 2^40 voxels.
VoxelGrid enclosing_grid(std::span<const std::filesystem::path> files,
                         std::span<const VoxelGrid> grids);

}  // namespace mesamis::detail::label_files
