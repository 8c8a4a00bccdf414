// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

/// Of each node of a mesh six bits: which planes of its box it lies on.
inline std::vector<std::uint8_t> box_planes(const TetMesh& mesh) {
  const Box box = bounding_box(mesh.points);
  std::vector<std::uint8_t> planes(mesh.points.size());
  parallel_for(mesh.points.size(), [&](std::size_t n) {
    unsigned mask = 0;
    for (int axis = 0; axis < 3; ++axis) {
      mask |= unsigned{mesh.points[n][axis] == box.lo[axis]} << (2 * axis);
      mask |= unsigned{mesh.points[n][axis] == box.hi[axis]} << (2 * axis + 1);
    }
    planes[n] = static_cast<std::uint8_t>(mask);
  });
  return planes;
}

}  // namespace mesamis
