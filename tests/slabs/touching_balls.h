// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/image/label_map.h"

namespace mesamis {

/// Two balls that touch: the second ends where the first begins. Their axis leans, so that slabs
/// cut both and what they share. On the last slice the map ends within the second.
inline LabelMap touching_balls() {
  LabelMap map;
  map.size = {18, 17, 30};
  map.spacing = {0.9, 1, 1.1};
  map.origin = {3, -4, 5};
  map.segments = {{"first", 1, 0, {255, 0, 0}}, {"second", 2, 0, {0, 255, 0}}};
  const Vec3 first{7, 7, 9}, second{8.5, 9, 22};
  map.layers.emplace_back();
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    const auto [i, j, k] = map.voxel(n);
    const Vec3 p{i * map.spacing.x, j * map.spacing.y, k * map.spacing.z};
    const int label = norm(p - first) < 6 ? 1 : norm(p - second) < 7.5 ? 2 : 0;
    map.layers[0].push_back(static_cast<std::uint16_t>(label));
  }
  return map;
}

}  // namespace mesamis
