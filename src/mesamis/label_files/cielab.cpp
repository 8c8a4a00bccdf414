// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/cielab.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/types.h"

namespace mesamis::detail::label_files {
namespace {

/// The inverse of CIE's f(t), which is the cube root but near 0.
double from_lab_scale(double f) {
  constexpr double kDelta = 6.0 / 29;
  return f > kDelta ? f * f * f : 3 * kDelta * kDelta * (f - 4.0 / 29);
}

std::uint8_t gamma_coded(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double coded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * coded));
}

}  // namespace

std::array<std::uint8_t, 3> srgb_from_cielab(const std::array<int, 3>& scaled) {
  const double lightness = scaled[0] * 100.0 / 65535;
  const double a = scaled[1] * 255.0 / 65535 - 128, b = scaled[2] * 255.0 / 65535 - 128;
  const double y = (lightness + 16) / 116;
  const Vec3 white{0.95047, 1, 1.08883};
  const Vec3 xyz{white.x * from_lab_scale(y + a / 500), white.y * from_lab_scale(y),
                 white.z * from_lab_scale(y - b / 200)};
  const Mat3 to_rgb{{Vec3{3.2404542, -1.5371385, -0.4985314},
                     Vec3{-0.9692660, 1.8760108, 0.0415560},
                     Vec3{0.0556434, -0.2040259, 1.0572252}}};
  const Vec3 rgb = to_rgb * xyz;
  return {gamma_coded(rgb.x), gamma_coded(rgb.y), gamma_coded(rgb.z)};
}

}  // namespace mesamis::detail::label_files
