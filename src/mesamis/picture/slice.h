// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesamis/image/slice_plane.h"
#include "mesamis/image/volume.h"
#include "mesamis/picture/color_scale.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::picture {

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
ValueRange slice_window(const Volume& volume);

/// The line segments in which triangles cross the slice, as pairs of points on the page.
std::vector<std::array<Vec3, 2>> outline(const Volume& volume, const SlicePlane& plane,
                                         const TriMesh& surface);

}  // namespace mesamis::detail::picture
