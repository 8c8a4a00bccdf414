// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/deliver.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/stopwatch.h"
#include "mesamis/method/choose.h"
#include "mesamis/method/expected_error.h"
#include "mesamis/method/follow_image.h"

namespace mesamis::detail::method {
namespace {

constexpr double kSnapped = 0.06;  // voxels that crossings may be left by

TriMesh followed(const RunInput& run, TriMesh extracted) {
  const Parameters& p = run.parameters;
  return follow_image(extracted, run.image,
                      {p.grey.to_grey(p.level), run.noise, p.unit_mm, p.follow, p.fit, p.preview});
}

void bring_surface_to_world(const RunInput& run, TriMesh& surface) {
  bring_to_world(run, surface.points);
  turn_as_grid(run, surface);
}

}  // namespace

SolidOptions solid_options(const RunInput& run) {
  const Parameters& p = run.parameters;
  SolidOptions options;
  options.box = run.box;
  if (p.fit) options.snap = kSnapped * run.grey.voxel_size() / p.unit_mm;
  return options;
}

void turn_as_grid(const RunInput& run, TriMesh& surface) {
  if (determinant(run.grey.direction) >= 0) return;
  for (Triangle& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
}

void deliver_surface(const RunInput& run, TriMesh extracted, Result& result) {
  Stopwatch watch;
  result.surface = followed(run, std::move(extracted));
  bring_surface_to_world(run, result.surface);
  result.seconds.surface += watch.lap();
}

void deliver_loop(const RunInput& run, Loop loop, const Progress& progress, Result& result) {
  begin_stage(progress, "surface");
  const Parameters& p = run.parameters;
  const TetMesh& mesh = loop.state.mesh;
  Stopwatch watch;
  if (p.surface == SurfaceKind::kBand) {
    result.surface = extract_band(mesh, loop.minimum.v, p.band_threshold);
    bring_surface_to_world(run, result.surface);
    result.seconds.surface = watch.lap();
  } else {
    TriMesh extracted =
        extract_solid(mesh, loop.minimum.u, p.grey.to_grey(p.level), solid_options(run));
    result.seconds.surface = watch.lap();
    deliver_surface(run, std::move(extracted), result);
  }
  deliver_mesh(run, std::move(loop), result);
}

void finish_surface(const RunInput& run, const Progress& progress, Result& result) {
  Parameters& p = result.parameters;
  result.printable.triangles_extracted = std::ssize(result.surface.triangles);
  if (p.surface == SurfaceKind::kBand) return;
  // Nothing of a preview depends on the error, which takes time to find.
  const double error = p.preview ? 0 : expected_shape_error(run, result.surface).mean;
  choose_tolerance(p, run.grey.voxel_size(), error, p.preview ? kErrorsOfPreview : kErrorsOfObject);
  if (p.preview) begin_stage(progress, "rounding");
  result.surface = make_printable(result.surface,
                                  {.min_volume = p.min_volume,
                                   .keep_largest = p.keep_largest,
                                   .fill_cavities = p.fill_cavities,
                                   .tolerance = *p.tolerance,
                                   .triangles = p.triangles,
                                   .progress = progress,
                                   .refit = !p.preview,
                                   .round = p.preview},
                                  &result.printable);
  tell_error(run, result);
}

void tell_error(const RunInput& run, Result& result) {
  ErrorOptions delivered = run.error;
  delivered.decimated =
      std::max(result.printable.extracted_to_result, result.printable.result_to_extracted);
  result.expected_error = expected_error(result.surface, run.image, delivered);
}

}  // namespace mesamis::detail::method
