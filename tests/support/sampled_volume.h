// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/volume.h"

namespace mesamis {

/// A volume whose samples are function(position in mm).
template <class Function>
Volume sampled_volume(const std::array<Index, 3>& size, const Vec3& spacing, Function&& function) {
  Volume volume;
  volume.size = size;
  volume.spacing = spacing;
  for (Index k = 0; k < size[2]; ++k) {
    for (Index j = 0; j < size[1]; ++j) {
      for (Index i = 0; i < size[0]; ++i) {
        volume.samples.push_back(
            static_cast<float>(function(Vec3{i * spacing.x, j * spacing.y, k * spacing.z})));
      }
    }
  }
  return volume;
}

}  // namespace mesamis
