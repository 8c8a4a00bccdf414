// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// Grids whose axes are not orthogonal, brought onto one whose are.
namespace mesamis::detail::volume_files {

/// A sheared grid and the one that replaces it.
struct ShearPlan {
  VoxelGrid grid;                  ///< what comes out
  std::array<Index, 3> size{};     ///< voxels of what goes in
  std::array<Vec3, 3> to_index{};  ///< rows: from mm beside the first voxel to its indices
  Vec3 first{};                    ///< the new first voxel beside the old one, LPS, mm
  std::string note;                ///< what was done to samples, in words
  std::string label_note;          ///< and to labels
};

/// Plans an orthogonal grid that holds all voxels of a sheared one: its first axis is that of the
/// old grid, its second lies in the plane of the first two, its planes are those of the old grid.
/// Rows and planes keep their distances.
/// @param old    size, origin and modality of the sheared grid.
/// @param steps  along its axes, LPS, mm.
/// @param file   begins the message.
/// @throws InputError  if the axes lie in a plane, or the new grid has more than 64 voxels for each
///                     old one.
///
/// O(1).
ShearPlan plan_unsheared(const std::filesystem::path& file, const VoxelGrid& old,
                         const std::array<Vec3, 3>& steps);

/// Interpolates samples onto the grid of a plan, linearly. What no voxel covers has the least
/// value.
/// @param samples  of the sheared grid.
/// @throws nothing
///
/// O(voxels of the new grid), in threads; the same bits for any number of them.
std::vector<float> unsheared(const ShearPlan& plan, const std::vector<float>& samples);

/// Takes labels from the nearest voxels of the sheared grid; what none covers has the label 0.
/// @param labels  of the sheared grid.
/// @throws nothing
///
/// O(voxels of the new grid), in threads.
std::vector<std::uint16_t> unsheared(const ShearPlan& plan,
                                     const std::vector<std::uint16_t>& labels);

}  // namespace mesamis::detail::volume_files
