// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "mesamis/picture/lighting.h"
#include "mesamis/picture/scene.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::picture {

/// A surface, and how it looks.
struct ShadedSurface {
  TriMesh surface;                               ///< sound indices, finite points
  std::vector<std::array<Vec3, 3>> normals;      ///< per triangle and corner; empty: flat triangles
  std::function<Colour(const Fragment&)> paint;  ///< the colour before light, from many threads
  std::optional<Colour> inside;                  ///< the colour of back faces, if it is another
  Reflectance reflectance;
  bool edges = false;  ///< the sides of the triangles are drawn
};

/// Draws a surface as the scene's camera sees it. Back faces are lit as if they were front faces.
///
/// O(triangles + pixels), with the memory of draw_triangles() and 36 bytes per point and triangle.
void draw_shaded(Scene& scene, const ShadedSurface& shown);

}  // namespace mesamis::detail::picture
