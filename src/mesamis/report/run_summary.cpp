// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/run_summary.h"

#include "mesamis/surface/self_intersections.h"

namespace mesamis::detail::report {
namespace {

template <class Array>
std::int64_t count(const Array& array) {
  return static_cast<std::int64_t>(array.size());
}

}  // namespace

double RunSummary::energy_mm3() const {
  const double unit = parameters.unit_mm;
  return iterations.back().energy.total() * unit * unit * unit;
}

RunSummary summarize(const Result& result, const SurfaceCheck& check) {
  RunSummary summary;
  summary.parameters = result.parameters;
  summary.image = result.image;
  summary.iterations = result.iterations;
  summary.tets = count(result.mesh.cells);
  summary.nodes = count(result.mesh.points);
  // A result need not have kept the mesh, which the last pass was on; a preview has none.
  if (summary.tets == 0 && !result.iterations.empty() && !result.parameters.preview) {
    summary.tets = result.iterations.back().tets;
    summary.nodes = result.iterations.back().nodes;
  }
  summary.fit = result.fit;
  summary.triangles = count(result.surface.triangles);
  summary.vertices = count(result.surface.points);
  summary.check = check;
  summary.self_intersections = count(find_self_intersections(result.surface));
  if (!result.expected_error.empty()) {
    summary.expected_error = summarize_error(result.surface, result.expected_error);
  }
  summary.printable = result.printable;
  summary.converged = result.converged;
  summary.seconds = result.seconds;
  summary.stopped = result.stopped;
  return summary;
}

}  // namespace mesamis::detail::report
