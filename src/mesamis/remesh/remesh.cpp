// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/remesh.h"

#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/remesh/explore.h"
#include "mesamis/remesh/remesher.h"

namespace mesamis::detail::remesh {

double cells_for_metric(const MetricField& metric, const Box& box) {
  return kCellsPerComplexity * probe_complexity({metric, box}, box);
}

TetMesh remesh(const TetMesh& start, const MetricField& metric, const RemeshOptions& options,
               RemeshReport* report) {
  Stopwatch watch;
  const Box box = bounding_box(start.points);
  const std::string flaw = find_flaw(start, box);
  if (!flaw.empty()) throw InputError("remesh: the start mesh is not valid: " + flaw);
  Remesher remesher(load(start, box), {metric, box}, options);
  remesher.adapt();
  remesher.polish();
  TetMesh result = unload(remesher.result());
  if (report != nullptr) {
    *report = remesher.report();
    report->seconds = watch.lap();
  }
  return result;
}

}  // namespace mesamis::detail::remesh
