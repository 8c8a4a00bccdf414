// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/triangle_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesamis/surface/measure.h"

namespace mesamis::detail::surface {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// The smallest angle of a triangle, degrees. The angle's tangent is twice the area over the
/// product of its sides, which keeps small angles exact.
double least_angle(const TriMesh& surface, std::size_t t) {
  const Triangle& k = surface.triangles[t];
  const double doubled_area = norm(area_vector(surface, t));
  if (!(doubled_area > 0)) return 0;
  double least = 60;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = surface.points[k[i]];
    const Vec3 a = surface.points[k[(i + 1) % 3]] - p, b = surface.points[k[(i + 2) % 3]] - p;
    least = std::min(least, kDegrees * std::atan2(doubled_area, dot(a, b)));
  }
  return least;
}

}  // namespace

TriangleShapes triangle_shapes(const TriMesh& surface) {
  TriangleShapes shapes;
  if (surface.triangles.empty()) return shapes;
  std::size_t above = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const double angle = least_angle(surface, t);
    shapes.least_angle = std::min(shapes.least_angle, angle);
    above += angle > 30;
  }
  shapes.share_above_30_deg =
      static_cast<double>(above) / static_cast<double>(surface.triangles.size());
  return shapes;
}

}  // namespace mesamis::detail::surface
