// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// Shapes as functions that are positive inside, at most 1-Lipschitz, and near their zero the
/// signed distance or close to it. Lengths in mm.
namespace mesamis::detail::phantom {

inline Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

/// std::hypot without its care for overflow, which costs more than a whole shape.
inline double length(double x, double y) { return std::sqrt(x * x + y * y); }

inline double ball(const Vec3& p, const Vec3& center, double radius) {
  return radius - norm(p - center);
}

/// Two discs in a plane: the radius of each and the distance between their centres, which is larger
/// than the difference of the radii.
struct Taper {
  double first, second, length;
};

/// Two discs and their common tangents, in a plane; the exact distance.
/// @param across  >= 0, from the line through the centres.
/// @param along   from the first centre towards the second.
inline double tapered_profile(double across, double along, const Taper& discs) {
  const auto [first, second, distance] = discs;
  const double sine = (first - second) / distance, cosine = std::sqrt(1 - sine * sine);
  const double k = cosine * along - sine * across;
  if (k < 0) return first - length(across, along);
  if (k > cosine * distance) return second - length(across, along - distance);
  return first - cosine * across - sine * along;
}

struct Ball {
  Vec3 center;
  double radius;
};

/// Two balls and the cone around both; the exact distance.
inline double tapered_capsule(const Vec3& p, const Ball& a, const Ball& b) {
  const double distance = norm(b.center - a.center);
  const double along = dot(p - a.center, b.center - a.center) / distance;
  const double across = std::sqrt(std::max(0.0, dot(p - a.center, p - a.center) - along * along));
  return tapered_profile(across, along, {a.radius, b.radius, distance});
}

/// Two balls of one radius and the cylinder around both; the exact distance.
inline double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double radius) {
  const Vec3 d = b - a;
  const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return radius - norm(p - a - t * d);
}

/// A box around the origin whose edges are rounded; the exact distance.
inline double round_box(const Vec3& p, const Vec3& half, double radius) {
  const Vec3 q{std::abs(p.x) - half.x + radius, std::abs(p.y) - half.y + radius,
               std::abs(p.z) - half.z + radius};
  const Vec3 beyond{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return radius - norm(beyond) - std::min(std::max({q.x, q.y, q.z}), 0.0);
}

/// How much a fillet adds where a and b differ by less than `width`.
inline double fillet(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0);
  return h * h / (4 * width);
}
/// The union; the groove between both is filled, with a radius of about `width`. Its gradient is a
/// mean of both gradients, so that it is 1-Lipschitz if they are, and continuous.
inline double smooth_union(double a, double b, double width) {
  return std::max(a, b) + fillet(a, b, width);
}
/// The intersection; its edges are rounded with a radius of about 0.85 `width`.
inline double smooth_intersection(double a, double b, double width) {
  return std::min(a, b) - fillet(a, b, width);
}

/// From 0 at lo to 1 at hi, with slopes 0 there and at most 1.5 / (hi - lo) between.
inline double smooth_step(double x, double lo, double hi) {
  const double t = std::clamp((x - lo) / (hi - lo), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace mesamis::detail::phantom
