// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/level_crossings.h"

#include <algorithm>
#include <array>

namespace mesamis {
namespace {

/// Calls visit(i, j, k, axis) where the line from voxel (i, j, k) to its next crosses the level.
template <class Visit>
void for_each_crossing(const VolumeView& volume, double level, Visit&& visit) {
  for (Index k = 0; k < volume.size[2]; ++k) {
    for (Index j = 0; j < volume.size[1]; ++j) {
      for (Index i = 0; i < volume.size[0]; ++i) {
        const bool here = volume.at(i, j, k) > level;
        if (i + 1 < volume.size[0] && (volume.at(i + 1, j, k) > level) != here) visit(i, j, k, 0);
        if (j + 1 < volume.size[1] && (volume.at(i, j + 1, k) > level) != here) visit(i, j, k, 1);
        if (k + 1 < volume.size[2] && (volume.at(i, j, k + 1) > level) != here) visit(i, j, k, 2);
      }
    }
  }
}

/// How often the grid lines of each axis cross the level.
std::array<std::size_t, 3> count_crossings(const VolumeView& volume, double level) {
  std::array<std::size_t, 3> count{};
  for_each_crossing(volume, level, [&count](Index, Index, Index, int axis) {
    ++count[static_cast<std::size_t>(axis)];
  });
  return count;
}

/// The crossing between voxel `at` and the next one along the axis.
SurfacePoint crossing(const VolumeView& volume, double level, std::array<Index, 3> at, int axis) {
  auto next = at;
  ++next[axis];
  const double a = volume.at(at[0], at[1], at[2]), b = volume.at(next[0], next[1], next[2]);
  const double t = std::clamp((level - a) / (b - a), 0.0, 1.0);
  SurfacePoint point;
  for (int c = 0; c < 3; ++c) point.position[c] = at[c] * volume.spacing[c];
  point.position[axis] += t * volume.spacing[axis];
  const Vec3 g = (1 - t) * gradient_at(volume, at[0], at[1], at[2]) +
                 t * gradient_at(volume, next[0], next[1], next[2]);
  point.normal = -1.0 * unit_or_zero(g);
  return point;
}

}  // namespace

Vec3 gradient_at(const VolumeView& volume, Index i, Index j, Index k) {
  const std::array<Index, 3> at{i, j, k};
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    auto low = at, high = at;
    low[axis] = std::max(at[axis] - 1, 0);
    high[axis] = std::min(at[axis] + 1, volume.size[axis] - 1);
    g[axis] = (volume.at(high[0], high[1], high[2]) - volume.at(low[0], low[1], low[2])) /
              ((high[axis] - low[axis]) * volume.spacing[axis]);
  }
  return g;
}

std::vector<SurfacePoint> crossing_points(const VolumeView& volume, double level,
                                          std::size_t most) {
  const auto count = count_crossings(volume, level);
  const std::size_t every =
      std::max<std::size_t>(1, (count[0] + count[1] + count[2]) / std::max<std::size_t>(1, most));
  std::vector<SurfacePoint> points;
  std::size_t n = 0;
  for_each_crossing(volume, level, [&](Index i, Index j, Index k, int axis) {
    if (n++ % every == 0) points.push_back(crossing(volume, level, {i, j, k}, axis));
  });
  return points;
}

double level_area(const VolumeView& volume, double level) {
  const auto count = count_crossings(volume, level);
  const Vec3& s = volume.spacing;
  return (static_cast<double>(count[0]) * s.y * s.z + static_cast<double>(count[1]) * s.x * s.z +
          static_cast<double>(count[2]) * s.x * s.y) /
         1.5;
}

}  // namespace mesamis
