// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/beneath.h"

#include <algorithm>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/locate.h"
#include "mesamis/surface/normals.h"

namespace mesamis {
namespace {

double value_at(const TetMesh& mesh, std::span<const double> u, const Location& place) {
  const Cell& cell = mesh.cells[static_cast<std::size_t>(place.cell)];
  double value = 0;
  for (std::size_t i = 0; i < 4; ++i) value += place.weights[i] * u[cell[i]];
  return value;
}

}  // namespace

std::vector<double> greatest_beneath(const TetMesh& mesh, std::span<const double> u,
                                     const TriMesh& surface, double depth, int samples) {
  if (u.size() != mesh.points.size()) {
    throw InputError("greatest beneath: " + std::to_string(u.size()) + " values for " +
                     std::to_string(mesh.points.size()) + " nodes");
  }
  if (!(depth >= 0) || samples < 1) {
    throw InputError("greatest beneath: expected a depth of 0 or more and a sample at least");
  }
  const Box box = bounding_box(mesh.points);
  const std::vector<Vec3> normals = vertex_normals(surface);
  const auto neighbors = cell_neighbors(mesh);
  std::vector<double> greatest(surface.points.size());
  constexpr std::size_t kPointsPerBlock = 1024;
  parallel_blocks(greatest.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    Index near = 0;  // points come in the order of the cells that made them
    for (std::size_t n = begin; n < end; ++n) {
      for (int s = 0; s <= samples; ++s) {
        Vec3 p = surface.points[n] - (depth * s / samples) * normals[n];
        // What rounding moved out of the mesh would be sought in every cell.
        for (int a = 0; a < 3; ++a) p[a] = std::clamp(p[a], box.lo[a], box.hi[a]);
        const Location place = locate(mesh, neighbors, p, near);
        near = place.cell;
        const double value = value_at(mesh, u, place);
        greatest[n] = s == 0 ? value : std::max(greatest[n], value);
      }
    }
  });
  return greatest;
}

}  // namespace mesamis
