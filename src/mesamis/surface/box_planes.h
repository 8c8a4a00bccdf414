// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::surface {

/// Of each node of a mesh the planes of a box that it lies on, see planes_of().
inline std::vector<std::uint8_t> box_planes(const TetMesh& mesh, const Box& box) {
  std::vector<std::uint8_t> planes(mesh.points.size());
  parallel_for(planes.size(), [&](std::size_t n) { planes[n] = planes_of(box, mesh.points[n]); });
  return planes;
}

/// Those of its own box.
inline std::vector<std::uint8_t> box_planes(const TetMesh& mesh) {
  return box_planes(mesh, bounding_box(mesh.points));
}

}  // namespace mesamis::detail::surface
