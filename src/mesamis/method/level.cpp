// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/level.h"

#include <vector>

#include "mesamis/restore/edge_level.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/sampling.h"

namespace mesamis {
namespace {

/// Evenly by area: small triangles crowd where the surface is bent, and such places are not to
/// decide for the others.
std::vector<SurfacePoint> points_by_area(const TriMesh& surface, double unit_mm) {
  std::vector<SurfacePoint> points;
  for (const TriangleSample& sample : sample_triangles_by_area(surface, unit_mm)) {
    points.push_back({sample.position, sample.normal});
  }
  return points;
}

}  // namespace

double choose_level(const VolumeView& volume, const Settings& settings,
                    const Parameters& parameters, const NodalField& field) {
  if (settings.level) return *settings.level;
  const GreyMap& map = parameters.grey;
  // Caps at the box are no edges of the image.
  const TriMesh surface =
      extract_solid(field.mesh, field.u, map.to_grey(parameters.level), {.close_at_box = false});
  if (surface.triangles.empty()) return parameters.level;
  const auto level = measure_edge_level(volume, points_by_area(surface, parameters.unit_mm));
  const bool clamped_away = level && map.has_threshold() && *level <= map.threshold;
  return level && !clamped_away ? *level : parameters.level;
}

}  // namespace mesamis
