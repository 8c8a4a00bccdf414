// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "mesamis/base/types.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// Places in the world, as a user writes them down from a viewer.
namespace mesamis::detail::object {

/// Reads a point "X,Y,Z".
/// @param text  three numbers, mm, in the frame.
/// @return LPS, mm.
/// @throws InputError  if the text is anything else.
Vec3 parse_point(std::string_view text, Frame frame);

/// Finds the voxel whose centre is nearest to a point of the world.
/// @param world  LPS, mm.
/// @return indices along i, j, k.
/// @throws InputError  if the point is more than half a voxel beyond the outermost centres; the
///                     message says where the scan is.
std::array<Index, 3> voxel_at(const VoxelGrid& grid, const Vec3& world);

/// Reads a box "X0:X1,Y0:Y1,Z0:Z1", of which ends and parts may be left out, see box_to_range(), or
/// "X0,Y0,Z0,X1,Y1,Z1", the lower corner and the upper one.
/// @return mm, in the frame in which it is written; infinite where an end is left out.
/// @throws InputError  if the text is anything else, or an end is not below the other.
Box parse_box(std::string_view text);

/// Finds the voxels in a box of the world, written as parse_box() reads it.
///
/// An end that is left out is open, and so is a part without a colon and numbers: "10:60,,:-250".
/// Where the grid's axes are those of the world, the range holds the voxels whose centres lie in
/// the box, faces included. The range of an oblique grid is the smallest that holds the box.
/// @param text  mm, in the frame.
/// @return at least 2 voxels along each axis.
/// @throws InputError  if the text is anything else, an end is not below the other, or the box
///                     holds fewer voxels; the message says where the scan is.
CropRange box_to_range(const VoxelGrid& grid, std::string_view text, Frame frame);

/// Finds the box of the world that holds the centres of a grid,
/// @return mm, in the frame.
Box world_box(const VoxelGrid& grid, Frame frame);

}  // namespace mesamis::detail::object
