// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::decimate {

/// A quadratic function of a place: the sum of squared distances from planes, each times a weight
/// (Garland and Heckbert 1997). Places are relative to an origin near by, which keeps digits.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< sum of w n n^T
  Vec3 linear{0, 0, 0};                                   ///< sum of w d n
  double constant = 0;                                    ///< sum of w d^2
  double weight = 0;                                      ///< sum of w

  /// Adds the plane n . x = d.
  void add_plane(const Vec3& n, double d, double w) {
    xx += w * n.x * n.x;
    xy += w * n.x * n.y;
    xz += w * n.x * n.z;
    yy += w * n.y * n.y;
    yz += w * n.y * n.z;
    zz += w * n.z * n.z;
    linear += (w * d) * n;
    constant += w * d * d;
    weight += w;
  }

  /// Adds two planes through a point that meet in a line of this direction, of unit length.
  void add_line(const Vec3& p, const Vec3& along, double w) {
    const Vec3 n = perpendicular_to(along), m = cross(along, n);
    add_plane(n, dot(n, p), w);
    add_plane(m, dot(m, p), w);
  }

  Quadric& operator+=(const Quadric& q) {
    xx += q.xx;
    xy += q.xy;
    xz += q.xz;
    yy += q.yy;
    yz += q.yz;
    zz += q.zz;
    linear += q.linear;
    constant += q.constant;
    weight += q.weight;
    return *this;
  }

  Vec3 product(const Vec3& x) const {
    return {xx * x.x + xy * x.y + xz * x.z, xy * x.x + yy * x.y + yz * x.z,
            xz * x.x + yz * x.y + zz * x.z};
  }

  /// At least 0 but for rounding.
  double at(const Vec3& x) const { return dot(x, product(x)) - 2 * dot(linear, x) + constant; }
};

/// The place where a quadric and a pull to another place together are least.
/// @param near    the other place.
/// @param pull    its weight, over that of the quadric, > 0.
/// @param stays   of each axis, whether the coordinate is that of the other place.
Vec3 minimum(const Quadric& q, const Vec3& near, double pull, const std::array<bool, 3>& stays);

}  // namespace mesamis::detail::decimate
