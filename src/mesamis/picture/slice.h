// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/picture/color_scale.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail {

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
/// @param volume    as require_usable() wants it.
/// @param axis      0 x (sagittal), 1 y (coronal), 2 z (axial), LPS.
/// @param position  mm along the axis; nullptr: the middle slice.
/// @throws InputError  if the position is more than half a voxel outside the volume.
SlicePlane slice_plane(const Volume& volume, int axis, const double* position);

/// Maps a point in LPS mm to the page: mm to the right, upwards and in depth, from the first voxel
/// of the slice.
Vec3 to_page(const Volume& volume, const SlicePlane& plane, const Vec3& world);

/// A mark at a side of a slice.
struct SideTick {
  double at;         ///< on the page, mm to the right or upwards, see to_page()
  std::string text;  ///< the LPS coordinate there, mm
};

/// Chooses marks along the bottom and the left side of a slice, at round numbers of the LPS
/// coordinate that runs along that side. On an oblique grid the numbers are those of the slice's
/// middle line.
/// @param volume  as require_usable() wants it.
std::array<std::vector<SideTick>, 2> side_ticks(const Volume& volume, const SlicePlane& plane);

/// Chooses the grey values of a volume's slices: from the 0.5 to the 99.5 percentile of the
/// samples. Of Hounsfield units those of -1500 and less do not count: they are padding, beyond what
/// the scanner saw.
/// @param volume  as require_usable() wants it.
///
/// O(voxels).
ValueRange slice_window(const Volume& volume);

/// The line segments in which triangles cross the slice, as pairs of points on the page.
///
/// O(triangles).
std::vector<std::array<Vec3, 2>> outline(const Volume& volume, const SlicePlane& plane,
                                         const TriMesh& surface);

}  // namespace mesamis::detail
