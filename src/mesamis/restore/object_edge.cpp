// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/object_edge.h"

#include <algorithm>
#include <cmath>

#include "mesamis/restore/edge_level.h"
#include "mesamis/restore/scan_quality.h"
#include "mesamis/restore/thick_places.h"
#include "mesamis/restore/value_variation.h"

namespace mesamis::detail::restore {
namespace {

constexpr std::size_t kMostPoints = 200'000;

/// Bound of the shell's thickness where the object is at least this thick, voxels. Where the way
/// through it was seen to end, what is behind the shell may be the back of a wall.
double thickest_shell(double thickness) {
  constexpr double kOneStepMore = 0.75;  // the way is looked at every half voxel
  return thickness < kLongestWay ? std::max(kThickestShell, thickness + kOneStepMore)
                                 : kThickestShell;
}

/// The edge at thick places.
/// @param guide  the volume, smoothed.
HalfMaximumLevel edge_of_thick_places(const VolumeView& volume, const VolumeView& guide,
                                      const HalfMaximumLevel& seen) {
  constexpr int kMostIterations = 3;
  constexpr double kTolerance = 0.005;  // change of the level, against the contrast
  HalfMaximumLevel object = seen;
  for (int n = 0; n < kMostIterations; ++n) {
    const auto [points, thickness] =
        thick_places(guide, crossing_points(guide, object.level, kMostPoints), object.level);
    const auto edge = measure_edge(volume, points, thickest_shell(thickness));
    if (!edge || !(edge->height() > 0)) break;
    const double change = std::abs(edge->level() - object.level);
    object.level = edge->level();
    object.contrast = {edge->background, edge->shell, points.size()};
    if (change < kTolerance * edge->height()) break;
  }
  return object;
}

/// How far the level is moved from that of thick places to that of the whole surface: not at all
/// for one material, half of the way where the object's value varies by 0.12 of the contrast.
double share_of_whole_surface(const VolumeView& volume, const VolumeView& guide,
                              const HalfMaximumLevel& thick) {
  constexpr double kOneMaterial = 0.06, kVaries = 0.12, kMost = 0.5;
  const auto points = crossing_points(guide, thick.level, kMostPoints);
  const ThickPlaces places = thick_places(guide, points, thick.level);
  if (places.least == 0) return 0;  // through the blur thin walls vary by themselves
  const double noise = measure_noise(volume, guide, points, thick.level);
  const double variation = measure_variation(volume, places.points, noise);
  const double share = variation / thick.contrast.difference();
  return kMost * std::clamp((share - kOneMaterial) / (kVaries - kOneMaterial), 0.0, 1.0);
}

}  // namespace

Window window_with_room(const VolumeView& volume, const ObjectContrast& contrast, double level) {
  const Window window = default_window(volume, contrast.background);
  const double room = std::abs(contrast.difference()) / 2;
  return {std::min(window.low, level - room), std::max(window.high, level + room)};
}

HalfMaximumLevel find_object_edge(const VolumeView& volume, const HalfMaximumLevel& seen) {
  if (!(seen.contrast.difference() > 0)) return seen;
  const Volume guide = smoothed(volume);
  HalfMaximumLevel object = edge_of_thick_places(volume, guide, seen);
  const double share = share_of_whole_surface(volume, guide, object);
  const auto between = [share](double thick, double whole) {
    return thick + share * (whole - thick);
  };
  object.uncertainty = std::abs(object.level - seen.level) / 2;
  object.level = between(object.level, seen.level);
  object.contrast.background = between(object.contrast.background, seen.contrast.background);
  object.contrast.object = between(object.contrast.object, seen.contrast.object);
  return object;
}

SeenObject see_object(const VolumeView& volume, const SeeOptions& options) {
  const HalfMaximumLevel seen = find_half_maximum_level(volume, {.start = options.start});
  if (!(seen.contrast.difference() > 0)) return {seen, seen, {}};
  const Window window = window_with_room(volume, seen.contrast, options.level.value_or(seen.level));
  return {seen, find_object_edge(clamped(volume, window), seen), window};
}

}  // namespace mesamis::detail::restore
