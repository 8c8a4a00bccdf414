// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
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

inline Volume make_ball(const BallVolume& ball) {
  Volume volume;
  volume.size = {ball.size, ball.size, ball.size};
  volume.spacing = ball.spacing;
  std::mt19937 generator(ball.seed);
  std::normal_distribution<double> noise(0, 1);
  const Vec3 center = 0.5 * volume.box().extent();
  auto step = [&ball](double distance) {  // 0 inside, 1 outside, blurred
    return 0.5 * (1 + std::erf(distance / (ball.blur * std::sqrt(2.0))));
  };
  for (Index k = 0; k < ball.size; ++k) {
    for (Index j = 0; j < ball.size; ++j) {
      for (Index i = 0; i < ball.size; ++i) {
        const Vec3 p{i * ball.spacing.x, j * ball.spacing.y, k * ball.spacing.z};
        const double r = norm(p - center);
        double value = ball.object + (ball.background - ball.object) * step(r - ball.radius);
        if (ball.air) value += (*ball.air - ball.background) * step(r - 1.5 * ball.radius);
        volume.samples.push_back(static_cast<float>(value + ball.noise * noise(generator)));
      }
    }
  }
  return volume;
}

}  // namespace mesamis
