// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/part_inside.h"

#include <algorithm>

#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::study {

TriMesh part_inside(const TriMesh& surface, const Volume& volume, const Vec3& margin) {
  const Box box{margin, volume.box().hi - margin};
  std::vector<bool> inside(surface.points.size());
  for (std::size_t i = 0; i < inside.size(); ++i) {
    inside[i] = box.contains(volume.to_grid(surface.points[i]));
  }
  TriMesh part{surface.points, {}};
  for (const Triangle& t : surface.triangles) {
    const auto is_inside = [&inside](Index p) { return inside[static_cast<std::size_t>(p)]; };
    if (std::all_of(t.begin(), t.end(), is_inside)) part.triangles.push_back(t);
  }
  return without_unused_points(part);
}

}  // namespace mesamis::detail::study
