// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/body_fit.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "mesamis/body/body_skin.h"
#include "mesamis/mesh/region.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/measure.h"

namespace mesamis::detail::body {
namespace {

std::int64_t count_of_skin_only(const BodyMesh& body) {
  const auto neighbors = cell_neighbors(body.mesh);
  std::vector<bool> on_boundary(body.mesh.points.size(), false);
  for (std::size_t c = 0; c < neighbors.size(); ++c) {
    for (std::size_t f = 0; f < 4; ++f) {
      if (neighbors[c][f] != kNoIndex) continue;
      for (const int i : kCellFaces[f]) on_boundary[body.mesh.cells[c][i]] = true;
    }
  }
  return std::ranges::count_if(body.mesh.cells, [&](const Cell& cell) {
    return std::ranges::all_of(cell, [&](Index p) { return on_boundary[p]; });
  });
}

double volume_of(const TriMesh& surface) {
  double sum = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) sum += cone_volume(surface, t);
  return sum;
}

}  // namespace

BodyFit measure_fit(const BodyMesh& body, std::span<const TriMesh> surfaces, double tolerance) {
  const auto skins = body_skins(body, surfaces.size());
  BodyFit fit;
  double volume = 0;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    volume += volume_of(surfaces[k]);
    if (skins[k].triangles.empty()) {
      fit.skin_to_surface = fit.surface_to_skin = std::numeric_limits<double>::infinity();
      continue;
    }
    const double fine = fine_enough(surfaces[k], tolerance);
    fit.skin_to_surface = std::max(fit.skin_to_surface, max_distance(skins[k], surfaces[k], fine));
    fit.surface_to_skin = std::max(fit.surface_to_skin, max_distance(surfaces[k], skins[k], fine));
  }
  fit.volume_ratio = mesh_volume(body.mesh) / volume;
  fit.elements_of_skin_only = count_of_skin_only(body);
  return fit;
}

}  // namespace mesamis::detail::body
