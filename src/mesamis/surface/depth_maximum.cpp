// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/depth_maximum.h"

#include <algorithm>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/locate.h"
#include "mesamis/surface/normals.h"

namespace mesamis::detail::surface {
namespace {

double value_at(const TetMesh& mesh, std::span<const double> u, const Location& place) {
  const Cell& cell = mesh.cells[static_cast<std::size_t>(place.cell)];
  double value = 0;
  for (std::size_t i = 0; i < 4; ++i) value += place.weights[i] * u[cell[i]];
  return value;
}

void require_inputs(const TetMesh& mesh, std::span<const double> u, const DepthRange& range) {
  if (u.size() != mesh.points.size()) {
    throw InputError("maximum below a surface: expected a value per node, found " +
                     std::to_string(u.size()) + " values for " +
                     std::to_string(mesh.points.size()) + " nodes");
  }
  if (!(range.depth >= 0)) {
    throw InputError("maximum below a surface: expected a depth of 0 mm or more, found " +
                     std::to_string(range.depth));
  }
  if (range.samples < 1) {
    throw InputError("maximum below a surface: expected at least 1 sample, found " +
                     std::to_string(range.samples));
  }
}

}  // namespace

std::vector<double> max_below_surface(const TetMesh& mesh, std::span<const double> u,
                                      const TriMesh& surface, const DepthRange& range) {
  require_inputs(mesh, u, range);
  const Box box = bounding_box(mesh.points);
  const std::vector<Vec3> normals = vertex_normals(surface);
  const auto neighbors = cell_neighbors(mesh);
  std::vector<double> maxima(surface.points.size());
  constexpr std::size_t kPointsPerBlock = 1024;
  parallel_blocks(maxima.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    Index cell = 0;  // points come in the order of the cells that made them
    for (std::size_t n = begin; n < end; ++n) {
      for (int s = 0; s <= range.samples; ++s) {
        Vec3 p = surface.points[n] - (range.depth * s / range.samples) * normals[n];
        // A point that rounding moved out of the mesh would be looked up in every cell.
        for (int a = 0; a < 3; ++a) p[a] = std::clamp(p[a], box.lo[a], box.hi[a]);
        const Location place = locate(mesh, neighbors, p, cell);
        cell = place.cell;
        const double value = value_at(mesh, u, place);
        maxima[n] = s == 0 ? value : std::max(maxima[n], value);
      }
    }
  });
  return maxima;
}

}  // namespace mesamis::detail::surface
