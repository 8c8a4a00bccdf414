// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>
#include <utility>

#include "mesamis/image/spline_image.h"
#include "support/ball_volume.h"
#include "support/solids.h"

namespace mesamis {

inline constexpr double kRadius = 11;

inline const SplineImage& ball_image() {
  static const SplineImage image =
      interpolating_spline(make_ball({.noise = 10, .radius = kRadius, .blur = 0.7}));
  return image;
}

/// A ball of another radius, whose points lie up to half a millimetre beside it.
inline TriMesh rough_ball(double radius) {
  TriMesh surface = moved(ball_surface(radius, 90), 0.5 * ball_image().grid.box().extent());
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for (Vec3& p : surface.points) {
    p += Vec3{uniform(generator), uniform(generator), uniform(generator)};
  }
  return surface;
}

/// Mean and deviation of the distance of the points from the ball's surface.
inline std::pair<double, double> distance_of(const TriMesh& surface) {
  const Vec3 centre = 0.5 * ball_image().grid.box().extent();
  double sum = 0, squares = 0;
  for (const Vec3& p : surface.points) {
    const double d = norm(p - centre) - kRadius;
    sum += d;
    squares += d * d;
  }
  const auto n = static_cast<double>(surface.points.size());
  return {sum / n, std::sqrt(squares / n - sum / n * sum / n)};
}

}  // namespace mesamis
