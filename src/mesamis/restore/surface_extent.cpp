// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/surface_extent.h"

#include <cmath>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/restore/edge_profile.h"
#include "mesamis/restore/level_crossings.h"
#include "mesamis/restore/thick_places.h"

namespace mesamis::detail::restore {
namespace {

constexpr double kThin = 2;  // voxels

/// Ways that end at the box tell nothing: they are 0.
bool is_thin(double way) { return way > 0 && way < kThin; }

/// The area for which a crossing stands, mm^2. A surface of the normal n has |n_a| / A_a crossings
/// per area with the grid lines along the axis a, A_a being the voxel's face across it.
double area_of_crossing(const VoxelGrid& grid, const Vec3& n) {
  const Vec3& s = grid.spacing;
  return s.x * s.y * s.z / (std::abs(n.x) * s.x + std::abs(n.y) * s.y + std::abs(n.z) * s.z);
}

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
  double of_thin = 0, of_all = 0;
  for (std::size_t n = 0; n < usable.size(); ++n) {
    const double area = area_of_crossing(image, usable[n]->normal);
    of_all += area;
    if (thin[n] != 0) of_thin += area;
  }
  return {level_area(image, level), of_all > 0 ? of_thin / of_all : 0};
}

}  // namespace mesamis::detail::restore
