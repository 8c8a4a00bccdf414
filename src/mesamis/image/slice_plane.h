// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// A slice of a voxel grid as it lies on a page.
namespace mesamis::detail::image {

/// The orientation of a slice of the voxel grid on the page.
struct SlicePlane {
  std::array<int, 3> axis{0, 1, 2};  ///< grid axes that run to the right, upwards and in depth
  std::array<int, 2> sign{1, 1};     ///< -1: the grid axis runs to the left, downwards
  Index index = 0;                   ///< of the slice along the depth axis
  std::array<char, 4> letters{};     ///< body sides left, right, below, above: L R A P S I
  double position = 0;               ///< LPS coordinate of the slice's centre, mm
};

/// Chooses a slice of the grid and its orientation on the page, as radiologists look at it: axial
/// from the feet, coronal from the front, both with the patient's left on the right; sagittal from
/// the patient's left, with the front on the left. The slice is across the grid axis nearest to the
/// axis given.
///
/// @param grid      at least 2 voxels along each axis, orthonormal directions.
/// @param axis      0 x (sagittal), 1 y (coronal), 2 z (axial), LPS.
/// @param position  mm along the axis; nullptr: the middle slice.
/// @throws InputError  if the position is more than half a voxel outside the grid.
SlicePlane slice_plane(const VoxelGrid& grid, int axis, const double* position);

/// The LPS direction of an axis of the grid, of length 1.
/// @param grid_axis  0 i, 1 j, 2 k.
Vec3 grid_direction(const VoxelGrid& grid, int grid_axis);

/// Maps a point in LPS mm to the page: mm to the right, upwards and in depth, from the first voxel
/// of the slice.
Vec3 to_page(const VoxelGrid& grid, const SlicePlane& plane, const Vec3& world);

}  // namespace mesamis::detail::image
