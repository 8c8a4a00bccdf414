// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/mes_amis.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/stopwatch.h"
#include "mesamis/method/expected_error.h"
#include "mesamis/method/follow_image.h"
#include "mesamis/method/loop.h"
#include "mesamis/method/passes.h"
#include "mesamis/method/prepare.h"
#include "mesamis/method/preview.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/surface/depth_maximum.h"
#include "mesamis/surface/extract.h"

namespace mesamis {
namespace {

/// The solid follows the image where that is more exact than the mesh.
TriMesh followed(const RunInput& run, TriMesh extracted) {
  const Parameters& p = run.parameters;
  if (!p.follow) return extracted;
  return follow_image(extracted, run.image, {p.grey.to_grey(p.level), run.error.noise, p.unit_mm});
}

TriMesh extract_surface(const RunInput& run, const Loop& loop) {
  const Parameters& p = run.parameters;
  const TetMesh& mesh = loop.state.mesh;
  if (p.surface == SurfaceKind::kBand) {
    return extract_band(mesh, loop.minimum.v, p.band_threshold);
  }
  return followed(run, extract_solid(mesh, loop.minimum.u, p.grey.to_grey(p.level)));
}

/// Puts the surface into the world frame. A left-handed grid turns every orientation round.
void deliver_surface(const RunInput& run, TriMesh& surface) {
  bring_to_world(run, surface.points);
  if (determinant(run.grey.direction) >= 0) return;
  for (Triangle& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
}

/// The solid is made printable, and its error told; the paper's band is delivered as it is.
void finish_surface(const RunInput& run, const Settings& settings, const Progress& progress,
                    Result& result) {
  Parameters& p = result.parameters;
  result.printable.triangles_extracted = std::ssize(result.surface.triangles);
  if (p.surface == SurfaceKind::kBand) return;
  if (!settings.tolerance && !settings.triangles) {
    p.tolerance = default_tolerance(run.grey.voxel_size(), mean_expected_error(run, result.surface),
                                    p.accuracy);
  }
  result.surface = make_printable(result.surface,
                                  {p.min_volume, p.keep_largest, p.fill_cavities, p.tolerance,
                                   p.triangles, progress, p.preview},
                                  &result.printable);
  ErrorOptions delivered = run.error;
  delivered.decimated =
      std::max(result.printable.extracted_to_result, result.printable.result_to_extracted);
  result.expected_error = expected_error(result.surface, run.image, delivered);
}

/// All passes, and the surface that comes of them.
void run_full(const RunInput& run, const Progress& progress, const HasEnough& enough,
              Result& result) {
  Loop loop = run_loop(run, progress, enough);
  Stopwatch watch;
  (void)Stage(progress, "surface");
  result.surface = extract_surface(run, loop);
  result.seconds.surface = watch.lap();
  deliver_surface(run, result.surface);
  deliver_mesh(run, std::move(loop), result);
}

/// The first pass alone, on the grid. It has converged where its solves have.
void run_preview(const RunInput& run, const Progress& progress, Result& result) {
  const Stage first(progress, "preview, on the voxel grid");
  TriMesh extracted = preview_surface({run, 1, first, result.iterations.emplace_back()});
  result.converged = result.iterations.back().amis.solver_converged;
  Stopwatch watch;
  (void)Stage(progress, "surface");
  result.surface = followed(run, std::move(extracted));
  result.seconds.surface = watch.lap();
  deliver_surface(run, result.surface);
}

/// What a run that has enough before its first pass can still deliver.
bool stops_at_preview(const Parameters& p, const HasEnough& enough) {
  return !p.preview && p.surface == SurfaceKind::kSolid && enough && enough();
}

Result run_on(const VolumeView& volume, const Settings& settings, const Progress& progress,
              const HasEnough& enough) {
  Stopwatch watch;
  Result result;
  Parameters& p = result.parameters;
  (void)Stage(progress, "preparation");
  const Prepared prepared = prepare_image(volume, settings);
  p = prepared.parameters;
  result.image = prepared.measured;
  result.seconds.prepare = watch.lap();

  const RunInput run(prepared);
  result.stopped = stops_at_preview(p, enough);
  p.preview |= result.stopped;
  if (p.preview) {
    run_preview(run, progress, result);
  } else {
    run_full(run, progress, enough, result);
  }
  result.converged &= !result.stopped;
  watch.lap();
  finish_surface(run, settings, progress, result);
  result.seconds.printable = watch.lap();
  return result;
}

}  // namespace

Result mes_amis(const VolumeView& volume, const Settings& settings, const Progress& progress,
                const HasEnough& enough) {
  Stopwatch watch;
  require_valid(settings);
  require_usable(volume);
  Result result = settings.crop == CropRange{}
                      ? run_on(volume, settings, progress, enough)
                      : run_on(crop(volume, settings.crop), settings, progress, enough);
  result.seconds.total = watch.lap();
  return result;
}

std::vector<double> surface_grey(const Result& result, double voxel) {
  constexpr double kVoxels = 2;
  constexpr int kSamples = 4;
  const bool solid = result.parameters.surface == SurfaceKind::kSolid;
  return max_below_surface(result.mesh, result.u, result.surface,
                           {.depth = solid ? kVoxels * voxel : 0, .samples = kSamples});
}

}  // namespace mesamis
