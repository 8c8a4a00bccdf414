// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <span>

#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/tri_mesh.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis {

/// Of the edges between two triangles; in the unit of the points.
struct EdgeLengths {
  double all = 0;
  double creases = 0;  ///< where triangles meet at more than 40 degrees
};

inline EdgeLengths edge_lengths(const TriMesh& surface) {
  EdgeLengths lengths;
  for_each_edge(
      sorted_half_edges(surface.triangles, surface.points.size()),
      [&](std::span<const HalfEdge> edge) {
        const double length = norm(surface.points[edge[0].lo] - surface.points[edge[0].hi]);
        const Vec3 one = unit_normal(corners_of(surface, surface.triangles[edge[0].triangle])),
                   other = unit_normal(corners_of(surface, surface.triangles[edge[1].triangle]));
        lengths.all += length;
        if (dot(one, other) < std::cos(40 * std::numbers::pi / 180)) lengths.creases += length;
      });
  return lengths;
}

}  // namespace mesamis
