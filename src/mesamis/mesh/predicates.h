// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::mesh {

/// Six times the volume of (a, b, c, d) in mm^3 if its sign is certainly positive, else 0.
///
/// The determinant must exceed a bound on its own rounding error, so that the sign of a positive
/// result is exact although no exact arithmetic is used. Source: Shewchuk, Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates, 1997, static filter orient3d.
inline double certified_six_volume(const Vec3& a, const Vec3& b, const Vec3& c,
                                   const Vec3& d) noexcept {
  constexpr double kErrorFactor = 8e-16;  // (7 + 56 eps) eps, rounded up
  const Vec3 p = b - a, q = c - a, r = d - a;
  const double qyrz = q.y * r.z, qzry = q.z * r.y;
  const double qxrz = q.x * r.z, qzrx = q.z * r.x;
  const double qxry = q.x * r.y, qyrx = q.y * r.x;
  const double det = p.x * (qyrz - qzry) - p.y * (qxrz - qzrx) + p.z * (qxry - qyrx);
  const double permanent = std::abs(p.x) * (std::abs(qyrz) + std::abs(qzry)) +
                           std::abs(p.y) * (std::abs(qxrz) + std::abs(qzrx)) +
                           std::abs(p.z) * (std::abs(qxry) + std::abs(qyrx));
  return det > kErrorFactor * permanent ? det : 0;
}

/// Six times the volume of (x, x + p, x + q, x + r) in mm^3 if certified_six_volume() is positive
/// for every even order of the four points, else 0.
///
/// Any coordinate of any edge is at most the sum of those of p, q and r, so six times the product
/// of the three sums bounds every order's permanent; three times that covers the errors of both
/// determinants and the bound.
inline double certified_in_any_order(const Vec3& p, const Vec3& q, const Vec3& r) noexcept {
  constexpr double kErrorFactor = 18 * 8e-16;
  const double det =
      p.x * (q.y * r.z - q.z * r.y) - p.y * (q.x * r.z - q.z * r.x) + p.z * (q.x * r.y - q.y * r.x);
  const double bound = (std::abs(p.x) + std::abs(q.x) + std::abs(r.x)) *
                       (std::abs(p.y) + std::abs(q.y) + std::abs(r.y)) *
                       (std::abs(p.z) + std::abs(q.z) + std::abs(r.z));
  return det > kErrorFactor * bound ? det : 0;
}

/// Whether certified_six_volume() is positive; points in mm.
inline bool certified_positive(const Vec3& a, const Vec3& b, const Vec3& c,
                               const Vec3& d) noexcept {
  return certified_six_volume(a, b, c, d) > 0;
}

}  // namespace mesamis::detail::mesh
