// SPDX-License-Identifier: Apache-2.0
// The tasks on voxels, and the first mesh.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "mesamis/adapt/size_control.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/grid_mass.h"
#include "mesamis/method/prepare.h"
#include "mesamis/slabs/grid_nodes.h"
#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/mesh_files.h"
#include "mesamis/slabs/tasks.h"

namespace mesamis::detail::slabs {
namespace {

/// Voxels that the restored image and its spline look across the border of a slab.
constexpr double kReach = 16;

std::string nodes_file(Index g) { return "nodes." + std::to_string(g); }
std::string grid_file(Index g) { return "grid." + std::to_string(g); }

/// Slices [begin, end) of the whole scan.
struct Slices {
  Index begin = 0, end = 0;
  Index count() const { return end - begin; }
};

/// Those that slab s owns, and so many on both sides, as far as there are any.
Slices slices_of(const SlabPlan& plan, Index s, Index around) {
  const auto at = static_cast<std::size_t>(s);
  return {std::max(0, plan.cuts[at] - around),
          std::min(plan.whole.size[2], plan.cuts[at + 1] + around)};
}

/// Slices of a volume that holds the slices `held` of the scan.
Volume cut_out(const Volume& volume, const Slices& held, const Slices& wanted) {
  CropRange range;
  range.begin[2] = wanted.begin - held.begin;
  range.end[2] = wanted.end - held.begin;
  return crop(volume, range);
}

/// Of some slices, see SlabRun::excess.
std::span<const float> excess_in(const SlabRun& run, const Slices& slices) {
  if (run.excess.values.empty()) return {};
  const VoxelGrid& whole = run.plan.whole;
  return run.excess.values.subspan(whole.offset(0, 0, slices.begin),
                                   whole.offset(0, 0, slices.count()));
}

void write_spline(const SlabRun& run, Index s, const SplineImage& image, const Slices& held) {
  const Slices own = slices_of(run.plan, s, 0);
  const VoxelGrid& whole = run.plan.whole;
  write_items<float>(run.scratch.path(kImageFile), whole.offset(0, 0, own.begin),
                     image.coefficients.subspan(image.grid.offset(0, 0, own.begin - held.begin),
                                                image.grid.offset(0, 0, own.count())));
}

SlabExtent extent_in(const SlabRun& run, Index s, const Prepared& prepared, const Slices& held) {
  Slices own = slices_of(run.plan, s, 0);
  // To where the next one begins; crossings within that slice count for both, which is little.
  own.end = std::min(own.end + 1, run.plan.whole.size[2]);
  Prepared part{prepared.parameters, prepared.measured, cut_out(prepared.grey, held, own), {}};
  return {cells_of(part), prepared.image.low, prepared.image.high};
}

/// The share of all cells that the first mesh has, where no bound acts on their number.
double share_of_first_mesh(const Prepared& prepared) {
  constexpr std::int64_t kMany = 1'000'000'000'000;
  Prepared many{prepared.parameters, prepared.measured, {}, {}};
  many.parameters.max_tets = kMany;
  return static_cast<double>(RunInput(many).cells_after(1)) / static_cast<double>(kMany);
}

/// The fields on the first grid of some slices, and the metric that they ask for.
struct SlabFields {
  GridWindow window;
  Iteration record;
};

/// @param cells  of the last mesh, that the slices ask for.
SlabFields minimise_on_slices(const SlabRun& run, Prepared prepared, const Slices& slices,
                              double cells) {
  const RunInput input(prepared);
  const Parameters& p = input.parameters;
  SlabFields fields;
  GridWindow& window = fields.window;
  const Pass pass{input, 1, silent_stage(), fields.record};
  GridPass found = minimise_on_grid(pass);
  window.box = {{0, 0, run.plan.height_of_slice(slices.begin)}, run.plan.box().hi};
  window.box.hi.z = run.plan.height_of_slice(slices.end - 1);
  window.size = found.grid.size;
  // Where nothing is to be seen, cells of the largest size: no bound at all would mesh the noise.
  const double fewest = window.box.volume() / std::pow(p.h_max, 3);
  const double wanted = share_of_first_mesh(prepared) * cells / kCellsPerComplexity;
  window.log_metrics =
      grid_log_metric(pass, found.grid, {found.minimum.u, found.minimum.v, found.image(input)},
                      {p.h_min, p.h_max, std::max(fewest, wanted)});
  window.u = std::move(found.minimum.u);
  window.v = std::move(found.minimum.v);
  return fields;
}

Box box_of_slab(const SlabPlan& plan, Index s) {
  Box box = plan.box();
  box.lo.z = plan.height(s);
  box.hi.z = plan.height(s + 1);
  return box;
}

/// The integral of sqrt(det M) over the slices that slab g owns, each node's share in its slice:
/// how many cells they will have, but for a factor.
std::vector<double> complexities_of_slices(const SlabPlan& plan, const Slices& own,
                                           const GridWindow& window) {
  const KuhnGrid grid = grid_of(window);
  const GridMass mass(grid);
  const auto slice = static_cast<std::size_t>(window.size[0]) * window.size[1];
  std::vector<double> sums(static_cast<std::size_t>(window.size[2]));
  parallel_for_each(sums.size(), [&](std::size_t k) {
    for (std::size_t n = k * slice; n < (k + 1) * slice; ++n) {
      sums[k] += mass.at(n) * std::exp(trace(unpack(window.log_metrics[n])) / 2);
    }
  });
  std::vector<double> complexities(static_cast<std::size_t>(own.count()), 0);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double height = window.box.lo.z + static_cast<double>(k) * grid.spacing.z;
    const auto at = static_cast<Index>(plan.slice_at(height));
    if (at >= own.begin && at < own.end) {
      complexities[static_cast<std::size_t>(at - own.begin)] += sums[k];
    }
  }
  return complexities;
}

/// The complexity of the first mesh's metric in some slices.
double complexity_in(const MeshRun& run, const Slices& slices) {
  double sum = 0;
  Index k = 0;
  for (const GridSlab& slab : run.grid) {
    for (const double complexity : slab.complexities) {
      if (k >= slices.begin && k < slices.end) sum += complexity;
      ++k;
    }
  }
  return sum / std::pow(run.mesh(1).factor, 3);
}

/// Bricks of less than a slab, in the same columns in every slab, so that slabs fit.
TetMesh start_mesh(const MeshRun& run, Index s) {
  const SlabPlan& plan = run.plan(1);
  const double size = std::min(run.input.parameters.h_max, plan.thinnest() / 1.5);
  const Box box = box_of_slab(plan, s);
  const Vec3 extent = box.extent();
  std::array<Index, 3> bricks{};
  for (int a = 0; a < 3; ++a) {
    bricks[static_cast<std::size_t>(a)] =
        std::max(1, static_cast<Index>(std::ceil(extent[a] / size)));
  }
  return box_mesh(box, bricks);
}

}  // namespace

SlabWork prepare_and_minimise(const SlabRun& run, Index g) {
  const SlabPlan& plan = run.plan;
  const double voxel = plan.whole.voxel_size() / plan.unit_mm;
  const Slices own = slices_of(plan, g, 0);
  const Slices held = slices_of(plan, g, plan.slices_in(kReach * voxel));
  const Volume scan = read_slab(run.source, held.begin, held.count());
  Prepared prepared = prepare_slab(scan, {scan, excess_in(run, held)}, run.choice);
  write_spline(run, g, prepared.image, held);
  const SlabExtent extent = extent_in(run, g, prepared, held);

  const Slices seen = slices_of(plan, g, plan.slices_in(plan.overlap));
  Prepared part{prepared.parameters, prepared.measured, cut_out(prepared.grey, held, seen), {}};
  prepared = {};
  const double around = static_cast<double>(seen.count()) / own.count();
  const SlabFields fields = minimise_on_slices(run, std::move(part), seen, around * extent.cells);
  const GridWindow nodes = slices_between(fields.window, plan.height(g), plan.height(g + 1));
  write_nodes(run.scratch.path(nodes_file(g)), nodes);
  ArchiveWriter archive;
  archive.add_one(nodes.box);
  archive.add_one(nodes.size);
  archive.add_one(extent);
  archive.add(complexities_of_slices(plan, own, fields.window));
  archive.add_one(fields.record);
  run.scratch.write(grid_file(g), archive);
  const auto slice = static_cast<std::int64_t>(plan.whole.offset(0, 0, 1));
  return {slice * held.count(), fields.record.nodes, 0,
          (held.count() - own.count()) * slice * static_cast<std::int64_t>(sizeof(float))};
}

std::vector<GridSlab> grid_slabs(const SlabRun& run) {
  std::vector<GridSlab> slabs(static_cast<std::size_t>(run.plan.count()));
  for (std::size_t g = 0; g < slabs.size(); ++g) {
    ArchiveReader archive = run.scratch.read(grid_file(static_cast<Index>(g)));
    GridSlab& slab = slabs[g];
    slab.frame.box = archive.next_one<Box>();
    slab.frame.size = archive.next_one<std::array<Index, 3>>();
    slab.extent = archive.next_one<SlabExtent>();
    slab.complexities = archive.next<double>();
    slab.record = archive.next_one<Iteration>();
  }
  return slabs;
}

void remove_grid_files(const SlabRun& run, Index g) { run.scratch.remove(nodes_file(g)); }

std::unique_ptr<Background> grid_background(const MeshRun& run, double low, double high, Index own,
                                            SlabWork& work) {
  const SlabPlan& plan = run.slabs.plan;
  const Parameters& p = run.input.parameters;
  const double factor = run.mesh(1).factor;
  std::vector<GridWindow> windows;
  for (Index g = 0; g < plan.count(); ++g) {
    if (plan.height(g + 1) <= low || plan.height(g) >= high) continue;
    const GridWindow& frame = run.grid[static_cast<std::size_t>(g)].frame;
    GridWindow& window =
        windows.emplace_back(read_nodes(run.slabs.scratch.path(nodes_file(g)), frame, low, high));
    if (factor != 1) scale_log_sizes(window.log_metrics, factor, {p.h_min, p.h_max, 0});
    if (g != own) work.bytes += kBytesOfNode * std::ssize(window.u);
  }
  return stack(std::move(windows));
}

SlabWork first_mesh(const MeshRun& run, Index s) {
  const SlabPlan& plan = run.plan(1);
  SlabWork work;
  const auto background = grid_background(run, plan.height(s), plan.height(s + 1), s, work);
  const double needed = complexity_in(run, slices_of(plan, s, 0));
  hand_on(run, 1, s, adapted(run, start_mesh(run, s), *background, needed, plan.thickness(s)),
          work);
  return work;
}

}  // namespace mesamis::detail::slabs
