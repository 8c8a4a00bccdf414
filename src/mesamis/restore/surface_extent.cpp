// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/surface_extent.h"

#include <algorithm>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/restore/edge_profile.h"
#include "mesamis/restore/level_crossings.h"
#include "mesamis/restore/thick_places.h"

namespace mesamis {
namespace {

constexpr double kThin = 2;  // voxels

/// Ways that end at the box tell nothing: they are 0.
bool is_thin(double way) { return way > 0 && way < kThin; }

}  // namespace

SurfaceExtent measure_extent(const VolumeView& image, double level) {
  constexpr std::size_t kMostPoints = 100'000;
  const auto points = crossing_points(image, level, kMostPoints);
  const PointGroup usable = with_normals(points);
  std::vector<char> thin(usable.size());
  parallel_for(usable.size(), [&](std::size_t n) {
    const Vec3 step = voxel_step(image, usable[n]->normal);
    thin[n] = is_thin(way_on_one_side(image, *usable[n], step, level)) ||
              is_thin(way_on_one_side(image, *usable[n], -1.0 * step, level));
  });
  const auto count = static_cast<double>(std::count(thin.begin(), thin.end(), 1));
  return {level_area(image, level), thin.empty() ? 0 : count / static_cast<double>(thin.size())};
}

}  // namespace mesamis
