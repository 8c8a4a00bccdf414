// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "support/shapes.h"

namespace mesamis {

/// Points spread over a box.
inline std::vector<Vec3> random_points(std::size_t count, const Vec3& lo, const Vec3& hi,
                                       unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = lo[axis] + uniform(generator) * (hi[axis] - lo[axis]);
    }
  }
  return points;
}

/// Triangles of every kind in the unit cube: with area, long and flat, points on a line, points
/// that coincide.
inline TriMesh mixed_triangles(std::size_t count) {
  TriMesh surface = random_triangles(count, {1, 1, 1}, 7);
  for (std::size_t t = 0; t < count; ++t) {
    auto corner = [&](std::size_t i) -> Vec3& { return surface.points[3 * t + i]; };
    const double height = std::pow(10.0, -static_cast<double>(t % 7));
    const Vec3 middle = corner(0) + 0.5 * (corner(1) - corner(0));
    if (t % 5 == 1) corner(2) = middle + height * (corner(2) - middle);
    if (t % 5 == 2) corner(2) = middle;
    if (t % 5 == 3) corner(t % 3) = corner((t + 1) % 3);
    if (t % 25 == 4) corner(0) = corner(1) = corner(2);
  }
  return surface;
}

}  // namespace mesamis
