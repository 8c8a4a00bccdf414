// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::surface {

TriMesh without_unused_points(const TriMesh& surface) {
  std::vector<Index> new_index(surface.points.size(), kNoIndex);
  for (const Triangle& t : surface.triangles) {
    for (const Index p : t) new_index[p] = 0;
  }
  TriMesh result;
  for (std::size_t p = 0; p < new_index.size(); ++p) {
    if (new_index[p] == kNoIndex) continue;
    new_index[p] = static_cast<Index>(result.points.size());
    result.points.push_back(surface.points[p]);
  }
  for (const Triangle& t : surface.triangles) {
    result.triangles.push_back({new_index[t[0]], new_index[t[1]], new_index[t[2]]});
  }
  return result;
}

}  // namespace mesamis::detail::surface
