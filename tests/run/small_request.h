// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/run/outcome_details.h"
#include "mesamis/run/segment.h"
#include "support/ball_volume.h"

namespace mesamis {

inline BallVolume small_ball() { return {.size = 26, .noise = 10, .radius = 7}; }

inline Settings small_settings() {
  Settings settings;
  settings.max_tets = 4000;
  settings.adaptations = 2;
  return settings;
}

/// For a ball in the middle of a cube.
inline Request ball_request() {
  Request request;
  request.scan = make_ball(small_ball());
  request.settings = small_settings();
  return request;
}

/// The two halves of the ball's cube, of which voxels within 8 mm of the middle are labelled.
inline LabelMap half_balls() {
  const Volume scan = make_ball(small_ball());
  LabelMap map;
  static_cast<VoxelGrid&>(map) = scan;
  map.layers.emplace_back(scan.samples.size());
  const Vec3 middle = 0.5 * scan.box().extent();
  std::size_t n = 0;
  for (Index k = 0; k < scan.size[2]; ++k) {
    for (Index j = 0; j < scan.size[1]; ++j) {
      for (Index i = 0; i < scan.size[0]; ++i, ++n) {
        const bool inside = norm(Vec3{1.0 * i, 1.0 * j, 1.0 * k} - middle) < 8;
        map.layers[0][n] = static_cast<std::uint16_t>(!inside ? 0 : i < middle.x ? 1 : 2);
      }
    }
  }
  map.segments = {{"left", 1, 0, {255, 0, 0}}, {"right", 2, 0, {0, 255, 0}}};
  return map;
}

/// The outcome of the request, made once.
inline const Outcome& ball_outcome() {
  static const Outcome outcome = segment(ball_request());
  return outcome;
}

/// That of the labels in the scan, with a mesh; made once.
inline const Outcome& halves_outcome() {
  static const Outcome outcome = [] {
    Request request = ball_request();
    request.labels = LabelChoice{half_balls()};
    return segment(std::move(request));
  }();
  return outcome;
}

}  // namespace mesamis
