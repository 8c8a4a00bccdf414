// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

/// What one triangle adds to the measures of its surface.
namespace mesamis::detail::surface {

/// The vector along the outward normal with twice the area as its length, mm^2.
/// @param t  a triangle's index in range.
inline Vec3 area_vector(const TriMesh& surface, std::size_t t) noexcept {
  const Triangle& k = surface.triangles[t];
  const Vec3& a = surface.points[k[0]];
  return cross(surface.points[k[1]] - a, surface.points[k[2]] - a);
}

/// The area of triangle t, mm^2.
inline double triangle_area(const TriMesh& surface, std::size_t t) noexcept {
  return 0.5 * norm(area_vector(surface, t));
}

/// The height of a triangle over its longest side, mm; 0 for one without area.
inline double triangle_height(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
  return longest > 0 ? norm(cross(b - a, c - a)) / longest : 0;
}

/// The signed volume of the cone over triangle t with a given apex, mm^3.
inline double cone_volume(const TriMesh& surface, std::size_t t, const Vec3& apex) noexcept {
  const Vec3& base = surface.points[surface.triangles[t][0]];
  return dot(base - apex, area_vector(surface, t)) / 6;
}

/// The signed volume of the cone over triangle t, mm^3; over a closed surface the cones add up to
/// its volume. The apex is the surface's first point: near the surface, so that little is lost to
/// round-off when it lies far from the origin.
inline double cone_volume(const TriMesh& surface, std::size_t t) noexcept {
  return cone_volume(surface, t, surface.points[0]);
}

}  // namespace mesamis::detail::surface
