// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "mesamis/surface/extract.h"

namespace mesamis {

/// The closed surface of {f > 0} in a box of n bricks.
inline TriMesh level_set(const Box& box, const std::array<Index, 3>& n,
                         const std::function<double(const Vec3&)>& f) {
  const TetMesh mesh = box_mesh(box, n);
  std::vector<double> u;
  for (const Vec3& p : mesh.points) u.push_back(f(p));
  return extract_solid(mesh, u, 0);
}

}  // namespace mesamis
