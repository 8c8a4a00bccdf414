// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/picture/raster.h"

namespace mesamis::detail::picture {

/// Triangles as they lie on a page.
struct PageTriangles {
  /// x and y: pixels to the right and downwards from the upper left corner of the picture; z:
  /// towards the viewer, any unit.
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;  ///< indices of points
};

/// What is seen at one place of a triangle.
struct Fragment {
  std::size_t triangle = 0;
  std::array<double, 3> weights{};  ///< barycentric coordinates, one per corner
  double side_distance = 0;         ///< to the nearest side of the triangle, pixels
};

/// The colour of a fragment. It is called from several threads at a time.
using Shader = std::function<Colour(const Fragment&)>;

/// Draws triangles onto a coloured picture: the mean of 3 x 3 places of each pixel, at each of
/// which the triangle nearest to the viewer is seen, or what was in the picture before. Of those
/// that are equally near the first is seen. Triangles that share a side leave no gap. What lies
/// outside the picture, is seen from its side or has coordinates that are not finite is left out.
///
/// O(triangles + pixels covered). Memory: 30 bytes per triangle, and 108 per pixel of 16 rows and
/// thread.
void draw_triangles(Raster& on, const PageTriangles& shown, const Shader& shader);

}  // namespace mesamis::detail::picture
