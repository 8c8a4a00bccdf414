// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "mesamis/image/volume.h"

namespace mesamis {

/// A blurred bright ball in the middle of a cube, with Gaussian noise; optionally inside a larger
/// soft ball that is surrounded by air.
struct BallVolume {
  Index size = 40;
  Vec3 spacing{1, 1, 1};
  double background = 120, object = 230, noise = 4;
  double radius = 11;  ///< mm
  double blur = 1;     ///< mm
  std::optional<double> air = std::nullopt;
  unsigned seed = 1;
};

/// The convolution of a ball's indicator with a Gaussian, at the distance r from the centre: its
/// middle value lies about sigma^2 / radius inside of the ball's surface.
inline double blurred_ball(double r, double radius, double sigma) {
  r = std::max(r, 1e-3 * sigma);
  const double a = (radius - r) / sigma, b = (radius + r) / sigma;
  return 0.5 * (std::erf(a / std::sqrt(2.0)) + std::erf(b / std::sqrt(2.0))) -
         sigma / (r * std::sqrt(2 * std::numbers::pi)) *
             (std::exp(-a * a / 2) - std::exp(-b * b / 2));
}

/// Where the middle value lies, r with blurred_ball(r) = 1/2: what an image's level set is at best,
/// if the blur is left as it is.
inline double middle_radius(double radius, double sigma) {
  double low = 0, high = radius;
  for (int i = 0; i < 60; ++i) {
    const double r = (low + high) / 2;
    (blurred_ball(r, radius, sigma) > 0.5 ? low : high) = r;
  }
  return low;
}

inline Volume make_ball(const BallVolume& ball) {
  Volume volume;
  volume.size = {ball.size, ball.size, ball.size};
  volume.spacing = ball.spacing;
  std::mt19937 generator(ball.seed);
  std::normal_distribution<double> noise(0, 1);
  const Vec3 center = 0.5 * volume.box().extent();
  for (Index k = 0; k < ball.size; ++k) {
    for (Index j = 0; j < ball.size; ++j) {
      for (Index i = 0; i < ball.size; ++i) {
        const Vec3 p{i * ball.spacing.x, j * ball.spacing.y, k * ball.spacing.z};
        const double r = norm(p - center);
        double value = ball.air.value_or(ball.background);
        value += (ball.object - ball.background) * blurred_ball(r, ball.radius, ball.blur);
        if (ball.air) {
          value += (ball.background - *ball.air) * blurred_ball(r, 1.5 * ball.radius, ball.blur);
        }
        volume.samples.push_back(static_cast<float>(value + ball.noise * noise(generator)));
      }
    }
  }
  return volume;
}

}  // namespace mesamis
