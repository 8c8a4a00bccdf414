// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/wall_width.h"

#include <limits>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/normals.h"

namespace mesamis::detail::body {
namespace {

/// A point of a surface, its outward normal, and the direction of the ball's middle, of length 1.
struct Place {
  Vec3 point, normal, toward;
};

double width_at(const SignedDistance& distance, const Place& place, double most) {
  const auto& [p, normal, toward] = place;
  constexpr int kSteps = 12;
  constexpr double kOpposite = -0.5;  // cosine between the normals of both sides
  constexpr double kRounding = 1e-3;
  // A ball that fits the wall is cut by the facets around the point, where these bend away from it:
  // by this share of its radius at 14 degrees.
  constexpr double kAlong = 0.9, kFacets = 0.03;
  double radius = 0.5 * most;
  bool is_wall = false;
  for (int step = 0; step < kSteps; ++step) {
    const NearestPoint touched = distance.at(p + radius * toward);
    const bool is_own_side = is_wall && dot(touched.normal, normal) > kAlong;
    if (touched.distance >= radius * (1 - (is_own_side ? kFacets : kRounding))) break;
    const Vec3 way = touched.point - p;
    const double along = dot(way, toward);
    if (!(along > 0)) break;
    const double smaller = dot(way, way) / (2 * along);
    if (!(smaller < radius)) break;
    radius = smaller;
    is_wall = dot(touched.normal, normal) < kOpposite;
  }
  return is_wall ? 2 * radius : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<double> wall_widths(const TriMesh& surface, const SignedDistance& distance, Side side,
                                double most) {
  const std::vector<Vec3> normals = vertex_normals(surface);
  std::vector<double> widths(surface.points.size());
  parallel_for(widths.size(), [&](std::size_t i) {
    const Vec3 toward = side == Side::kWall ? -normals[i] : normals[i];
    widths[i] = width_at(distance, {surface.points[i], normals[i], toward}, most);
  });
  return widths;
}

}  // namespace mesamis::detail::body
