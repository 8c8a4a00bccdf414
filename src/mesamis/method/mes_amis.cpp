// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/mes_amis.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/stopwatch.h"
#include "mesamis/method/deliver.h"
#include "mesamis/method/loop.h"
#include "mesamis/method/passes.h"
#include "mesamis/method/prepare.h"
#include "mesamis/method/preview.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/surface/depth_maximum.h"

namespace mesamis::detail::method {
namespace {

/// All passes, and the surface that comes of them.
void run_full(const RunInput& run, const Progress& progress, const HasEnough& enough,
              Result& result) {
  deliver_loop(run, run_loop(run, progress, enough), progress, result);
}

/// The first pass alone, on the grid. It has converged where its solves have.
void run_preview(const RunInput& run, const Progress& progress, Result& result) {
  const Stage first(progress, "preview, on the voxel grid");
  TriMesh extracted = preview_surface({run, 1, first, result.iterations.emplace_back()});
  result.converged = result.iterations.back().amis.solver_converged;
  begin_stage(progress, "surface");
  deliver_surface(run, std::move(extracted), result);
}

/// What a run that has enough before its first pass can still deliver.
bool stops_at_preview(const Parameters& p, const HasEnough& enough) {
  return !p.preview && p.surface == SurfaceKind::kSolid && enough && enough();
}

Result run_on(const VolumeView& volume, const ImageSettings& settings, const Progress& progress,
              const HasEnough& enough) {
  Stopwatch watch;
  Result result;
  begin_stage(progress, "preparation");
  Prepared prepared = prepare_image(volume, settings);
  result.stopped = stops_at_preview(prepared.parameters, enough);
  prepared.parameters.preview |= result.stopped;
  result.parameters = prepared.parameters;
  result.image = prepared.measured;
  result.seconds.prepare = watch.lap();

  const RunInput run(prepared);
  if (run.parameters.preview) {
    run_preview(run, progress, result);
  } else {
    run_full(run, progress, enough, result);
  }
  result.converged &= !result.stopped;
  watch.lap();
  finish_surface(run, progress, result);
  result.seconds.printable = watch.lap();
  return result;
}

}  // namespace

Result mes_amis(const VolumeView& volume, const ImageSettings& settings, const Progress& progress,
                const HasEnough& enough) {
  Stopwatch watch;
  const CropRange& range = settings.asked.crop;
  require_valid(settings.asked);
  require_usable(volume);
  Result result = range == CropRange{} ? run_on(volume, settings, progress, enough)
                                       : run_on(crop(volume, range), settings, progress, enough);
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

}  // namespace mesamis::detail::method
