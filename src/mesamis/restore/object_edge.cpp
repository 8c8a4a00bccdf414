// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/object_edge.h"

#include <cmath>

#include "mesamis/image/grey_values.h"
#include "mesamis/restore/edge_level.h"
#include "mesamis/restore/thick_places.h"

namespace mesamis {

HalfMaximumLevel find_object_edge(const VolumeView& volume, const HalfMaximumLevel& seen) {
  constexpr int kMostIterations = 3;
  constexpr std::size_t kMostPoints = 200'000;
  constexpr double kTolerance = 0.005;  // change of the level, against the contrast
  if (!(seen.contrast.difference() > 0)) return seen;
  const Volume guide = smoothed(volume);
  HalfMaximumLevel object = seen;
  for (int n = 0; n < kMostIterations; ++n) {
    const auto points =
        thick_places(guide, crossing_points(guide, object.level, kMostPoints), object.level);
    const auto edge = measure_edge(volume, points);
    if (!edge || !(edge->height() > 0)) break;
    const double change = std::abs(edge->level() - object.level);
    object.level = edge->level();
    object.contrast = {edge->background, edge->shell, points.size()};
    if (change < kTolerance * edge->height()) break;
  }
  return object;
}

}  // namespace mesamis
