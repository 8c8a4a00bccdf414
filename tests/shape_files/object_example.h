// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/shape_files/object_files.h"
#include "support/shapes.h"

namespace mesamis {

/// Two cubes with a common face, whose coordinates single precision does not hold, and a third one.
inline std::vector<NamedSurface> three_objects() {
  const double side = 1.0 / 3;
  return {{"left <hip> & \"c\"", {255, 128, 3}, 7, cube({-100.1, 42.7, 3.3}, side)},
          {"H\xc3\xbc"
           "fte",
           {0, 51, 204},
           2,
           cube({-100.1 + side, 42.7, 3.3}, side)},
          {"sacrum", {1, 2, 254}, 300, cube({0.1, 0.2, 0.3}, 20)}};
}

}  // namespace mesamis
