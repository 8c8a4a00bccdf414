// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/mes_amis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/method/expected_error.h"
#include "mesamis/method/follow_image.h"
#include "mesamis/method/passes.h"
#include "mesamis/method/prepare.h"
#include "mesamis/method/preview.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/surface/depth_maximum.h"
#include "mesamis/surface/extract.h"

namespace mesamis {
namespace {

std::string adaptation_name(int k, const Parameters& p) {
  return "adaptation " + std::to_string(k) + " of " + std::to_string(p.adaptations);
}

/// What the loop leaves: the last mesh, the fields that belong to it, and its history.
struct Loop {
  State state;
  Minimum minimum;
  std::vector<Iteration> passes;
  bool settled = false;
};

/// Records how far the energy moved in the last pass.
void record_energy_change(std::vector<Iteration>& passes) {
  const double before = passes.rbegin()[1].energy.total(), now = passes.back().energy.total();
  passes.back().energy_change = std::abs(now - before) / before;
}

Loop run_loop(const RunInput& run, const Progress& progress) {
  const Parameters& p = run.parameters;
  Loop loop;
  const Stage first(progress, adaptation_name(1, p) + ", on the voxel grid");
  loop.state = adapt_from_grid({run, 1, first, loop.passes.emplace_back()});
  for (int k = 2; k <= p.adaptations && !loop.settled; ++k) {
    const Stage stage(progress, adaptation_name(k, p));
    const Pass pass{run, k, stage, loop.passes.emplace_back()};
    const Minimum minimum = minimise(pass, loop.state, run.draft_options());
    record_energy_change(loop.passes);
    record_surface(pass, loop.state, minimum);
    loop.state = adapt(pass, loop.state, minimum);
    loop.settled = has_settled(run, loop.passes);
  }
  const Stage last(progress, "final minimisation");
  const Pass pass{run, p.adaptations, last, loop.passes.emplace_back()};
  loop.minimum = minimise(pass, loop.state, run.final_options());
  record_energy_change(loop.passes);
  record_surface(pass, loop.state, loop.minimum);
  return loop;
}

/// Every solve and, if asked for, the loop itself.
bool has_converged(const Loop& loop) {
  const auto solved = [](const Iteration& pass) { return pass.amis.solver_converged; };
  return loop.settled && std::all_of(loop.passes.begin(), loop.passes.end(), solved);
}

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

/// D M D' / unit^2 with D the direction cosines.
std::vector<Sym3> world_metric(const RunInput& run, const std::vector<Sym3>& metric) {
  const auto& r = run.grey.direction.rows;
  const double scale = 1 / (run.parameters.unit_mm * run.parameters.unit_mm);
  std::vector<Sym3> world(metric.size());
  parallel_for(world.size(), [&](std::size_t n) {
    const std::array<Vec3, 3> mr{metric[n] * r[0], metric[n] * r[1], metric[n] * r[2]};
    world[n] = scale * Sym3{dot(r[0], mr[0]), dot(r[0], mr[1]), dot(r[0], mr[2]),
                            dot(r[1], mr[1]), dot(r[1], mr[2]), dot(r[2], mr[2])};
  });
  return world;
}

/// Puts mesh, fields and surface into the world frame. A left-handed grid turns every orientation
/// round.
void deliver(const RunInput& run, Loop loop, Result& result) {
  bring_to_world(run, loop.state.mesh.points);
  bring_to_world(run, result.surface.points);
  if (determinant(run.grey.direction) < 0) {
    for (Cell& cell : loop.state.mesh.cells) std::swap(cell[2], cell[3]);
    for (Triangle& triangle : result.surface.triangles) std::swap(triangle[1], triangle[2]);
  }
  result.metric = world_metric(run, loop.state.metric);
  result.mesh = std::move(loop.state.mesh);
  result.u = std::move(loop.minimum.u);
  result.v = std::move(loop.minimum.v);
  result.f = std::move(loop.minimum.f);
  result.iterations = std::move(loop.passes);
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
void run_full(const RunInput& run, const Progress& progress, Result& result) {
  Loop loop = run_loop(run, progress);
  result.converged = has_converged(loop);
  result.fit = measure_fit(loop.state.mesh, loop.state.metric);
  Stopwatch watch;
  (void)Stage(progress, "surface");
  result.surface = extract_surface(run, loop);
  result.seconds.surface = watch.lap();
  deliver(run, std::move(loop), result);
}

/// The first pass alone, on the grid. It has converged where its solves have.
void run_preview(const RunInput& run, const Progress& progress, Result& result) {
  Loop loop;
  const Stage first(progress, "preview, on the voxel grid");
  TriMesh extracted = preview_surface({run, 1, first, loop.passes.emplace_back()});
  result.converged = loop.passes.back().amis.solver_converged;
  Stopwatch watch;
  (void)Stage(progress, "surface");
  result.surface = followed(run, std::move(extracted));
  result.seconds.surface = watch.lap();
  deliver(run, std::move(loop), result);
}

Result run_on(const VolumeView& volume, const Settings& settings, const Progress& progress) {
  Stopwatch watch;
  Result result;
  Parameters& p = result.parameters;
  (void)Stage(progress, "preparation");
  const Prepared prepared = prepare_image(volume, settings);
  p = prepared.parameters;
  result.image = prepared.measured;
  result.seconds.prepare = watch.lap();

  const RunInput run(prepared);
  (p.preview ? run_preview : run_full)(run, progress, result);
  watch.lap();
  finish_surface(run, settings, progress, result);
  result.seconds.printable = watch.lap();
  return result;
}

}  // namespace

Result mes_amis(const VolumeView& volume, const Settings& settings, const Progress& progress) {
  Stopwatch watch;
  require_valid(settings);
  require_usable(volume);
  Result result = settings.crop == CropRange{}
                      ? run_on(volume, settings, progress)
                      : run_on(crop(volume, settings.crop), settings, progress);
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
