// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/lighting.h"

#include <algorithm>
#include <cmath>

namespace mesamis::detail::picture {
namespace {

struct Light {
  Vec3 from;  // of length 1
  double intensity;
};

/// x^18, with the same bits on every machine.
double shininess(double x) {
  const double x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  return x8 * x8 * x2;
}

}  // namespace

Colour lit(const Colour& colour, const Vec3& normal, const Reflectance& reflectance) noexcept {
  static const std::array<Light, 3> kLights{{{unit_or_zero({-0.7, 0.9, 1.0}), 0.72},
                                             {unit_or_zero({0.9, -0.5, 0.6}), 0.22},
                                             {{0, 0, 1}, 0.32}}};
  double diffuse = 0, specular = 0;
  for (const Light& light : kLights) {
    const double facing = dot(normal, light.from);
    if (facing <= 0) continue;
    diffuse += light.intensity * facing;
    const double mirrored = 2 * facing * normal.z - light.from.z;  // towards the viewer
    if (mirrored > 0) specular += light.intensity * shininess(mirrored);
  }
  const double own = reflectance.ambient + reflectance.diffuse * diffuse;
  Colour result{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = own * colour[c] + 255 * reflectance.specular * specular;
    result[c] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  }
  return result;
}

}  // namespace mesamis::detail::picture
