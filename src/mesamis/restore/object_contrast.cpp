// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/object_contrast.h"

#include <cmath>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/restore/edge_profile.h"

namespace mesamis::detail::restore {
namespace {

constexpr std::size_t kFewestPoints = 10;

}  // namespace

std::optional<Vec3> place_along_normal(const VolumeView& guide, const SurfacePoint& point,
                                       double voxels, double level) {
  const Vec3 step = std::copysign(1.0, voxels) * voxel_step(guide, point.normal);
  const Box box = guide.box();
  Vec3 p;
  for (const double distance : {0.75, 1.5, 2.5}) {
    if (distance > std::abs(voxels)) break;
    p = point.position + distance * step;
    if (!box.contains(p) || (interpolate(guide, p) > level) != (voxels < 0)) return std::nullopt;
  }
  return p;
}

std::optional<ObjectContrast> measure_contrast(const VolumeView& volume, const VolumeView& guide,
                                               const std::vector<SurfacePoint>& points,
                                               double level) {
  constexpr double kDistance = 1.5;  // voxels
  const auto values_at = [&](double distance) {
    std::vector<std::optional<double>> found(points.size());
    parallel_for(points.size(), [&](std::size_t n) {
      if (norm(points[n].normal) == 0) return;
      const auto place = place_along_normal(guide, points[n], distance, level);
      if (place) found[n] = interpolate(volume, *place);
    });
    std::vector<double> values;
    for (const auto& value : found) {
      if (value) values.push_back(*value);
    }
    return values;
  };
  std::vector<double> inside = values_at(-kDistance), outside = values_at(kDistance);
  if (inside.size() < kFewestPoints || outside.size() < kFewestPoints) return std::nullopt;
  ObjectContrast contrast;
  contrast.object = median(inside);
  contrast.background = median(outside);
  contrast.samples = inside.size() + outside.size();
  return contrast;
}

}  // namespace mesamis::detail::restore
