// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/meshing_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/signed_distance.h"

namespace mesamis::detail::report {
namespace {

constexpr double kLeastAngle = 20, kShareAbove30 = 0.99;

std::string text_of(const char* format, double a, double b) {
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), format, a, b);
  return text.data();
}

/// The weights of the corners at a point of a triangle; those of its middle where it has no area.
std::array<double, 3> weights_at(const std::array<Vec3, 3>& corner, const Vec3& p) {
  const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double square = dot(normal, normal);
  if (!(square > 0)) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
  const auto weight = [&](std::size_t i) {
    const Vec3 &a = corner[(i + 1) % 3], &b = corner[(i + 2) % 3];
    return std::clamp(dot(cross(b - a, p - a), normal) / square, 0.0, 1.0);
  };
  return {weight(0), weight(1), weight(2)};
}

}  // namespace

std::string unmet(const MeshingQuality& q) {
  std::string missed;
  const auto add = [&](const std::string& text) { missed += (missed.empty() ? "" : "; ") + text; };
  if (!(q.triangles.least_angle >= kLeastAngle)) {
    add(text_of("a least angle of %.3g degrees, expected %.3g", q.triangles.least_angle,
                kLeastAngle));
  }
  if (!(q.triangles.share_above_30_deg >= kShareAbove30)) {
    add(text_of("%.4g %% of the triangles above 30 degrees, expected %.3g %%",
                100 * q.triangles.share_above_30_deg, 100 * kShareAbove30));
  }
  const double distance = std::max(q.to_given, q.from_given);
  if (!(distance <= q.tolerance)) {
    add(text_of("a distance of %.4g mm, expected %.4g mm", distance, q.tolerance));
  }
  if (q.self_intersections > 0) {
    add(std::to_string(q.self_intersections) + " pairs of triangles that meet, expected 0");
  }
  return missed;
}

MeshingQuality meshing_quality(const TriMesh& surface, const TriMesh& given, double tolerance) {
  const double fine = fine_enough(given, tolerance);
  return {triangle_shapes(surface), tolerance, max_distance(surface, given, fine),
          max_distance(given, surface, fine), std::ssize(find_self_intersections(surface))};
}

std::vector<double> carried_errors(const TriMesh& surface, const std::vector<double>& errors,
                                   const std::vector<Vec3>& points) {
  const SignedDistance distance(surface);
  std::vector<double> carried(points.size());
  parallel_for(points.size(), [&](std::size_t n) {
    const NearestPoint nearest = distance.at(points[n]);
    const Triangle& k = surface.triangles[static_cast<std::size_t>(nearest.triangle)];
    const auto weights = weights_at(
        {surface.points[k[0]], surface.points[k[1]], surface.points[k[2]]}, nearest.point);
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) error += weights[i] * errors[k[i]];
    carried[n] = error > 0 ? std::hypot(error, nearest.distance) : 0;
  });
  return carried;
}

}  // namespace mesamis::detail::report
