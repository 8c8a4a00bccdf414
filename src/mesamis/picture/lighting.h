// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/types.h"
#include "mesamis/picture/raster.h"

namespace mesamis::detail::picture {

/// How a surface answers to light, as shares of its colour.
struct Reflectance {
  double ambient = 0.14;
  double diffuse = 0.88;
  double specular = 0;  ///< of white
};

/// The colour of a surface under a key light from the upper left, a weaker one from the lower right
/// and one from the viewer.
/// @param normal  of length 1: to the right, upwards, towards the viewer; the last one >= 0.
Colour lit(const Colour& colour, const Vec3& normal, const Reflectance& reflectance) noexcept;

}  // namespace mesamis::detail::picture
