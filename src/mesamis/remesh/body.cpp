// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/body.h"

#include <algorithm>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/mesh/region.h"
#include "mesamis/remesh/cut.h"
#include "mesamis/remesh/remesher.h"

namespace mesamis::detail::remesh {
namespace {

/// The cells inside.
BodyMesh unload_body(const WorkingMesh& mesh) {
  std::vector<Index> inside;
  BodyMesh body;
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) {
    const Material material = mesh.cells[c].material;
    if (material == kOutside) continue;
    inside.push_back(c);
    body.materials.push_back(material);
  }
  body.mesh = restrict_mesh(unload(mesh), inside).mesh;
  return body;
}

}  // namespace

BodyMesh remesh_body(const TetMesh& start, const MetricField& metric, const BodyShape& shape,
                     const RemeshOptions& options) {
  Stopwatch watch;
  const Box box = bounding_box(start.points);
  const std::string flaw = find_flaw(start, box);
  if (!flaw.empty()) throw InputError("remesh_body: the start mesh is not valid: " + flaw);
  const MetricSampler sampler(metric, box);
  Remesher remesher(cut_along_border(start, shape, sampler), sampler, options);
  remesher.adapt();
  remesher.polish();
  remesher.repair();
  if (options.balanced) remesher.balance();
  BodyMesh body = unload_body(remesher.result());
  body.report = remesher.report();
  body.report.seconds = watch.lap();
  return body;
}

}  // namespace mesamis::detail::remesh
