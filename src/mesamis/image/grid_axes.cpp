// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/grid_axes.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mesamis/base/error.h"

namespace mesamis::detail::image {
namespace {

double column_cosine(const std::array<Vec3, 3>& unit) {
  return std::max({std::abs(dot(unit[0], unit[1])), std::abs(dot(unit[1], unit[2])),
                   std::abs(dot(unit[2], unit[0]))});
}

/// The orthonormal matrix closest to three nearly orthonormal columns: Newton's iteration
/// for the polar decomposition, Q <- (Q + Q^-T)/2.
std::array<Vec3, 3> nearest_orthonormal(std::array<Vec3, 3> q) {
  for (int step = 0; step < 6; ++step) {
    const double det = dot(q[0], cross(q[1], q[2]));
    const std::array<Vec3, 3> cofactor{cross(q[1], q[2]), cross(q[2], q[0]), cross(q[0], q[1])};
    for (std::size_t a = 0; a < 3; ++a) q[a] = 0.5 * (q[a] + (1 / det) * cofactor[a]);
  }
  return q;
}

template <class... Parts>
[[noreturn]] void refuse_axes(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw InputError(text.str());
}

}  // namespace

GridAxes grid_axes(const std::array<Vec3, 3>& steps) {
  GridAxes axes;
  std::array<Vec3, 3> unit;
  for (std::size_t a = 0; a < 3; ++a) {
    const double length = norm(steps[a]);
    if (!(length > 0) || !std::isfinite(length)) {
      refuse_axes("expected a positive voxel spacing along axis ", a, ", found ", length, " mm");
    }
    axes.spacing[static_cast<int>(a)] = length;
    unit[a] = (1 / length) * steps[a];
  }
  axes.skew = column_cosine(unit);
  if (!(axes.skew <= kSkewTolerance)) {
    refuse_axes("expected orthogonal voxel axes (cosines up to ", kSkewTolerance,
                "), found a cosine of ", axes.skew);
  }
  if (axes.skew > 0) unit = nearest_orthonormal(unit);
  for (Vec3& axis : unit) axis += Vec3{};  // -0 becomes 0
  axes.direction = transpose(Mat3{unit});
  return axes;
}

}  // namespace mesamis::detail::image
