// SPDX-License-Identifier: Apache-2.0
// How each mesh is cut into slabs, and how large it may be.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/mesh_files.h"
#include "mesamis/slabs/profile.h"

namespace mesamis::detail::slabs {
namespace {

/// How far cells reach that are adapted again, in overlaps, about.
constexpr double kReachOfSeam = 0.8;

/// Of the logarithm of the first mesh's number of cells.
constexpr double kSlackOfFirstMesh = 0.05;

/// Cuts slabs of equal predicted cells.
/// @param cells  of each slice, any unit.
void cut_mesh(const SlabRun& run, const std::vector<double>& cells, bool bounded, MeshPlan& mesh) {
  const SlabPlan& plan = run.plan;
  mesh.slabs = plan_slabs(plan.whole, cells,
                          {.unit_mm = plan.unit_mm,
                           .beta = run.choice.parameters.functional.beta,
                           .slabs = plan.count(),
                           .bounded = bounded,
                           .again = kReachOfSeam * plan.overlap});
  for (Index s = 0; s < plan.count(); ++s) {
    const auto* cut = &mesh.slabs.cuts[static_cast<std::size_t>(s)];
    mesh.predicted.push_back(std::accumulate(cells.begin() + cut[0], cells.begin() + cut[1], 0.0));
  }
}

/// The slabs asked for as many cells as their own surfaces need; now it is known how many there may
/// be.
MeshPlan plan_first_mesh(const MeshRun& run) {
  std::vector<double> complexities;  // of the slices
  for (const GridSlab& slab : run.grid) {
    complexities.insert(complexities.end(), slab.complexities.begin(), slab.complexities.end());
  }
  MeshPlan first;
  // Each slice of the grid that a slab sees is in its memory.
  cut_mesh(run.slabs, complexities, true, first);
  first.complexity = static_cast<double>(run.input.cells_after(1)) / kCellsPerComplexity;
  const double asked = std::accumulate(complexities.begin(), complexities.end(), 0.0);
  const double excess = std::log(asked / first.complexity);
  if (std::abs(excess) > kSlackOfFirstMesh) first.factor = std::exp(excess / 3);
  return first;
}

/// The cells of each slab of mesh k.
std::vector<double> cells_of_slabs(const MeshRun& run, int k) {
  std::vector<double> cells;
  cells.reserve(static_cast<std::size_t>(run.count()));
  for (Index s = 0; s < run.count(); ++s) {
    cells.push_back(static_cast<double>(mesh_record(run, k, s).iteration.tets));
  }
  return cells;
}

/// The cells of each slice of mesh k + 1, any unit: as the metric has it, and as each slab of mesh
/// k came to have more or fewer cells than were predicted.
/// @param cells  of the slabs of mesh k.
std::vector<double> cells_of_slices(const MeshRun& run, int k,
                                    const std::vector<Complexities>& slices,
                                    const std::vector<double>& cells, double factor) {
  std::vector<double> predicted;
  for (std::size_t s = 0; s < cells.size(); ++s) {
    const double before = run.mesh(k).predicted[s];
    const double made = before > 0 ? cells[s] / before : 1;
    const auto* cut = &run.plan(k).cuts[s];
    for (Index slice = cut[0]; slice < cut[1]; ++slice) {
      predicted.push_back(made * complexity_at(slices[static_cast<std::size_t>(slice)], factor));
    }
  }
  return predicted;
}

}  // namespace

MeshRun::MeshRun(const SlabRun& run)
    : slabs(run),
      prepared{run.choice.parameters, run.choice.measured, {}, {}},
      input(prepared),
      grid(grid_slabs(run)) {
  const VoxelGrid& whole = run.plan.whole;
  double cells = 0;
  for (const GridSlab& slab : grid) cells += slab.extent.cells;
  choose_max_tets(prepared.parameters, cells, count());
  static_cast<VoxelGrid&>(prepared.grey) = whole;
  auto mapped = map_items<float>(run.scratch.path(kImageFile), whole.voxel_count());
  prepared.image = {whole, mapped.values, grid[0].extent.low, grid[0].extent.high, mapped.owner};
  input.box = run.plan.box();
  input.excess = {whole, run.excess.values};
  meshes.push_back(plan_first_mesh(*this));
}

// The remesher's cells per unit of complexity are taken to be those that the mesh was measured to
// have; but the first mesh has cells which only the bricks of its start ask for.
void plan_next_mesh(MeshRun& run) {
  const auto k = static_cast<int>(run.meshes.size());
  std::vector<Complexities> slices(static_cast<std::size_t>(run.slabs.plan.whole.size[2]));
  for (Index s = 0; s < run.count(); ++s) {
    ArchiveReader archive = run.slabs.scratch.read(file_of("profile", k, s));
    add_next_profile(archive, slices);
  }
  const std::vector<double> cells = cells_of_slabs(run, k);
  const double made = std::accumulate(cells.begin(), cells.end(), 0.0) / run.mesh(k).complexity;
  const double per_complexity = k == 1 ? kCellsPerComplexity : std::clamp(made, 4.0, 20.0);
  MeshPlan next;
  next.complexity = static_cast<double>(run.input.cells_after(k + 1)) / per_complexity;
  next.factor = factor_for(sum_of(slices), next.complexity);
  cut_mesh(run.slabs, cells_of_slices(run, k, slices, cells, next.factor), false, next);
  run.meshes.push_back(std::move(next));
}

}  // namespace mesamis::detail::slabs
