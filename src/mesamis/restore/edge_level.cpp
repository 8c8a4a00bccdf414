// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/edge_level.h"

#include "mesamis/restore/edge_profile.h"

namespace mesamis::detail::restore {

std::optional<EdgeModel> measure_edge(const VolumeView& volume,
                                      const std::vector<SurfacePoint>& points, double thickest) {
  constexpr double kMostResidual = 0.02;  // against the height; a sharp kernel overshoots
  const PointGroup usable = with_normals(points);
  if (usable.size() < kFewestProfilePoints) return std::nullopt;
  const EdgeModel edge = fit_edge_model(median_profile(volume, usable), thickest);
  if (!(edge.residual < kMostResidual * edge.height())) return std::nullopt;
  return edge;
}

}  // namespace mesamis::detail::restore
