// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/normals.h"

#include "mesamis/surface/measure.h"

namespace mesamis::detail::surface {

std::vector<Vec3> vertex_normals(const TriMesh& surface) {
  require_sound(surface);
  std::vector<Vec3> normals(surface.points.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Vec3 weighted = area_vector(surface, t);
    for (const Index p : surface.triangles[t]) normals[p] += weighted;
  }
  for (Vec3& n : normals) n = unit_or_zero(n);
  return normals;
}

}  // namespace mesamis::detail::surface
