// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/line_crossing.h"

namespace mesamis::detail::report {
namespace {

/// Twice the area of the triangle of an edge and a point, seen along x.
double side_of(const NumberedCorner& a, const NumberedCorner& b, double y, double z) {
  if (a.number > b.number) return -side_of(b, a, y, z);
  return (b.at.y - a.at.y) * (z - a.at.z) - (b.at.z - a.at.z) * (y - a.at.y);
}

/// Whether a point is on the left of an edge. One that lies on it counts as if it were moved along
/// y by a hair, and along z by a hair of that: of the two directions of an edge exactly one has it,
/// and of the triangles around a corner those that a line nearby crosses.
bool is_left(const NumberedCorner& a, const NumberedCorner& b, double side) {
  if (side != 0) return side > 0;
  return b.at.z != a.at.z ? b.at.z < a.at.z : b.at.y > a.at.y;
}

}  // namespace

std::optional<LineCrossing> line_crossing(const std::array<NumberedCorner, 3>& c, double y,
                                          double z) {
  std::array<double, 3> side;  // opposite of each corner
  int left = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const NumberedCorner &a = c[(n + 1) % 3], &b = c[(n + 2) % 3];
    side[n] = side_of(a, b, y, z);
    left += is_left(a, b, side[n]) ? 1 : 0;
  }
  if (left != 0 && left != 3) return std::nullopt;
  const double area = side[0] + side[1] + side[2];
  if (area == 0) return std::nullopt;
  const double x = (side[0] * c[0].at.x + side[1] * c[1].at.x + side[2] * c[2].at.x) / area;
  // To the left of all edges along x means that the normal points along x, and the line leaves.
  return LineCrossing{x, left == 3 ? -1 : 1};
}

}  // namespace mesamis::detail::report
