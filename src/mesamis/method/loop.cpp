// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/image/trilinear.h"

namespace mesamis::detail::method {
namespace {

std::string adaptation_name(int k, const Parameters& p) {
  return "adaptation " + std::to_string(k) + " of " + std::to_string(p.adaptations);
}

/// Records how far the energy moved in the last pass.
void record_energy_change(std::vector<Iteration>& passes) {
  const double before = passes.rbegin()[1].energy.total(), now = passes.back().energy.total();
  passes.back().energy_change = std::abs(now - before) / before;
}

/// Every solve and, if asked for, the loop itself.
bool has_converged(const Loop& loop) {
  const auto solved = [](const Iteration& pass) { return pass.amis.solver_converged; };
  return loop.settled && std::all_of(loop.passes.begin(), loop.passes.end(), solved);
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

/// See Result::level_excess.
/// @param points  length units.
std::vector<double> excess_at(const RunInput& run, const std::vector<Vec3>& points) {
  if (run.excess.samples.empty()) return {};
  const VolumeView& excess = run.excess;
  const Trilinear between(excess);
  const double scale = run.parameters.grey.grey_per_native();
  const double unit = run.parameters.unit_mm;
  std::vector<double> found(points.size());
  parallel_for(found.size(), [&](std::size_t n) {
    const Vec3 p = unit * points[n];
    found[n] = scale *
               between.at({p.x / excess.spacing.x, p.y / excess.spacing.y, p.z / excess.spacing.z});
  });
  return found;
}

}  // namespace

Loop run_loop(const RunInput& run, const Progress& progress, const HasEnough& enough) {
  const Parameters& p = run.parameters;
  Loop loop;
  const auto minimise_last = [&](const Pass& pass, const AmisOptions& options) {
    const State& state = loop.state;
    Minimum minimum = minimise(pass, state.mesh, {state.u, state.v}, options);
    record_energy_change(loop.passes);
    record_surface(pass, state.mesh, state.u, minimum.u);
    return minimum;
  };
  const Stage first(progress, adaptation_name(1, p) + ", on the voxel grid");
  loop.state = adapt_from_grid({run, 1, first, loop.passes.emplace_back()});
  for (int k = 2; k <= p.adaptations && !loop.settled; ++k) {
    loop.stopped = enough && enough();
    if (loop.stopped) break;
    const Stage stage(progress, adaptation_name(k, p));
    const Pass pass{run, k, stage, loop.passes.emplace_back()};
    loop.state = adapt(pass, loop.state, minimise_last(pass, run.draft_options()));
    loop.settled = has_settled(run, loop.passes);
  }
  const Stage last(progress, "final minimisation");
  loop.minimum =
      minimise_last({run, p.adaptations, last, loop.passes.emplace_back()}, run.final_options());
  return loop;
}

void deliver_mesh(const RunInput& run, Loop loop, Result& result) {
  TetMesh& mesh = loop.state.mesh;
  result.converged = has_converged(loop);
  result.stopped = loop.stopped;
  if (!mesh.cells.empty()) result.fit = measure_fit(mesh, loop.state.metric);
  result.level_excess = excess_at(run, mesh.points);
  bring_to_world(run, mesh.points);
  if (determinant(run.grey.direction) < 0) {
    for (Cell& cell : mesh.cells) std::swap(cell[2], cell[3]);
  }
  result.metric = world_metric(run, loop.state.metric);
  result.mesh = std::move(mesh);
  result.u = std::move(loop.minimum.u);
  result.v = std::move(loop.minimum.v);
  result.f = std::move(loop.minimum.f);
  for (std::size_t n = 0; n < result.level_excess.size(); ++n) {
    result.u[n] += result.level_excess[n];
    result.f[n] += result.level_excess[n];
  }
  result.iterations = std::move(loop.passes);
}

}  // namespace mesamis::detail::method
