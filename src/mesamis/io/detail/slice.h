// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail {

/// How a slice of the voxel grid lies on the page: which grid axis runs to the right, which
/// upwards, which is cut, and whether a grid axis runs against the page's.
struct SlicePlane {
  std::array<int, 3> axis{0, 1, 2};  ///< grid axis along right, up, depth
  std::array<int, 2> sign{1, 1};     ///< of right and up
  Index index = 0;                   ///< of the slice along the depth axis
  std::array<char, 4> letters{};     ///< what lies left, right, below, above: L R A P S I
  double position = 0;               ///< LPS coordinate of the slice's centre, mm
};

/// Lays a slice on the page as radiologists do: axial seen from the feet, coronal from the
/// front, both with the patient's left on the right; sagittal from the patient's left, front on
/// the left. The slice is the grid's own: that of the grid axis nearest to the asked one.
///
/// @param axis      0 x (sagittal), 1 y (coronal), 2 z (axial), LPS.
/// @param position  mm along it, nullptr: the middle slice.
/// @throws InputError  if the volume does not reach the position.
SlicePlane slice_plane(const Volume& volume, int axis, const double* position);

/// Mm on the page of a point of space: x right, y up, z deep, from voxel (0, 0, index).
Vec3 to_page(const Volume& volume, const SlicePlane& plane, const Vec3& world);

/// Where triangles cross the slice: pairs of points on the page.
std::vector<std::array<Vec3, 2>> outline(const Volume& volume, const SlicePlane& plane,
                                         const TriMesh& surface);

}  // namespace mesamis::detail
