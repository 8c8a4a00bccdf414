// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/centre_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace mesamis::detail::report {
namespace {

/// Whether the corners lie on one plane of voxel centres across an axis.
bool on_centres(const std::array<Vec3, 3>& c, int axis, double hair) {
  const double plane = std::round(c[0][axis]);
  return std::all_of(c.begin(), c.end(),
                     [&](const Vec3& p) { return std::abs(p[axis] - plane) <= hair; });
}

/// Six times the volume inside: negative where the surface or the axes are mirrored.
double six_volumes(const std::vector<Vec3>& points, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    sum += dot(a - points[0], cross(b - points[0], c - points[0]));
  }
  return sum;
}

}  // namespace

bool move_centre_faces(std::vector<Vec3>& voxels, std::span<const Triangle> triangles, double hair,
                       double by) {
  const double outward = six_volumes(voxels, triangles) < 0 ? -1 : 1;
  std::vector<std::array<std::uint8_t, 3>> seen;  // along each axis: 1 faces forward, 2 backward
  for (const Triangle& t : triangles) {
    const std::array<Vec3, 3> c{voxels[t[0]], voxels[t[1]], voxels[t[2]]};
    for (int axis = 0; axis < 3; ++axis) {
      if (!on_centres(c, axis, hair)) continue;
      const Vec3 normal = outward * cross(c[1] - c[0], c[2] - c[0]);
      if (std::abs(normal[axis]) <= 0.5 * norm(normal)) continue;  // a splinter
      seen.resize(voxels.size());
      for (const Index p : t) {
        seen[static_cast<std::size_t>(p)][static_cast<std::size_t>(axis)] |=
            static_cast<std::uint8_t>(normal[axis] > 0 ? 1 : 2);
      }
    }
  }
  for (std::size_t p = 0; p < seen.size(); ++p) {
    for (int axis = 0; axis < 3; ++axis) {
      const int faces = seen[p][static_cast<std::size_t>(axis)];
      if (faces == 1) voxels[p][axis] += by;
      if (faces == 2) voxels[p][axis] -= by;
    }
  }
  return !seen.empty();
}

}  // namespace mesamis::detail::report
