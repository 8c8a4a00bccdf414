// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/thick_places.h"

#include <algorithm>
#include <iterator>

#include "mesamis/base/parallel.h"
#include "mesamis/restore/edge_profile.h"

namespace mesamis::detail::restore {
namespace {

constexpr double kClear = 2.5;  // voxels without object, outwards
constexpr double kStep = 0.5;   // voxels
constexpr int kMostSteps = static_cast<int>(kLongestWay / kStep);

/// How thick the object is below a point, voxels; 0 where it cannot be told.
double thickness_below(const VolumeView& guide, const SurfacePoint& point, double level) {
  if (norm(point.normal) == 0) return 0;
  const Vec3 voxel = voxel_step(guide, point.normal);
  if (way_on_one_side(guide, point, voxel, level) < kClear) return 0;
  return way_on_one_side(guide, point, -1.0 * voxel, level);
}

}  // namespace

double way_on_one_side(const VolumeView& image, const SurfacePoint& from, const Vec3& step,
                       double level) {
  const bool inside = dot(step, from.normal) < 0;
  const Box box = image.box();
  for (int n = 2; n <= kMostSteps; ++n) {
    const Vec3 p = from.position + kStep * n * step;
    if (!box.contains(p)) return 0;
    if ((interpolate(image, p) > level) != inside) return kStep * (n - 1);
  }
  return kStep * kMostSteps;
}

ThickPlaces thick_places(const VolumeView& guide, const std::vector<SurfacePoint>& points,
                         double level) {
  constexpr double kThinner = 0.75;  // of the points
  constexpr std::size_t kFewest = 100;
  std::vector<double> thickness(points.size());
  parallel_for(points.size(),
               [&](std::size_t n) { thickness[n] = thickness_below(guide, points[n], level); });
  std::vector<double> sorted;
  std::copy_if(thickness.begin(), thickness.end(), std::back_inserter(sorted),
               [](double t) { return t > 0; });
  if (sorted.size() < kFewest) return {points, 0};
  const auto at = static_cast<std::ptrdiff_t>(kThinner * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + at, sorted.end());
  ThickPlaces thick{{}, sorted[static_cast<std::size_t>(at)]};
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (thickness[n] >= thick.least) thick.points.push_back(points[n]);
  }
  return thick;
}

}  // namespace mesamis::detail::restore
