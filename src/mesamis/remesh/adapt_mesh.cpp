// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/adapt_mesh.h"

#include "mesamis/mesh/metric_field.h"

namespace mesamis::detail::remesh {
namespace {

constexpr double kFitToKeep = 0.5;

MeshFit fit_to(const MetricField& field, const TetMesh& mesh) {
  return measure_fit(mesh, sample(field, mesh.points));
}

}  // namespace

AdaptedMesh adapt_mesh(const TetMesh& mesh, std::span<const Sym3> node_metrics,
                       const RemeshOptions& options) {
  const MeshMetricField field(mesh, node_metrics);
  AdaptedMesh adapted;
  adapted.kept_start = measure_fit(mesh, node_metrics).unit_edge_fraction >= kFitToKeep;
  const TetMesh start = adapted.kept_start ? mesh : coarse_box_mesh(bounding_box(mesh.points));
  adapted.mesh = remesh(start, field, options, &adapted.report);
  adapted.fit = fit_to(ScaledMetricField(field, adapted.report.size_factor), adapted.mesh);
  return adapted;
}

}  // namespace mesamis::detail::remesh
