// SPDX-License-Identifier: Apache-2.0
// The tasks on voxels, and the first mesh.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/fem/grid_mass.h"
#include "mesamis/method/prepare.h"
#include "mesamis/slabs/mapped_floats.h"
#include "mesamis/slabs/mesh_files.h"
#include "mesamis/slabs/tasks.h"

namespace mesamis::detail {
namespace {

/// Voxels that the restored image and its spline look across the border of a slab.
constexpr double kReach = 16;

std::string fields_file(Index s) { return "fields." + std::to_string(s); }
std::string record_file(Index s) { return "grid." + std::to_string(s); }
std::string extent_file(Index s) { return "extent." + std::to_string(s); }

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

void write_spline(const SlabRun& run, Index s, const SplineImage& image, const Slices& held) {
  const Slices own = slices_of(run.plan, s, 0);
  const VoxelGrid& whole = run.plan.whole;
  write_floats(run.scratch.path(kImageFile), whole.offset(0, 0, own.begin),
               image.coefficients.subspan(image.grid.offset(0, 0, own.begin - held.begin),
                                          image.grid.offset(0, 0, own.count())));
}

SlabExtent extent_in(const SlabRun& run, Index s, const Prepared& prepared, const Slices& held) {
  Slices own = slices_of(run.plan, s, 0);
  // To where the next one begins; crossings within that slice count for both, which is little.
  own.end = std::min(own.end + 1, run.plan.whole.size[2]);
  Prepared part{prepared.parameters, prepared.measured, cut_out(prepared.grey, held, own), {}};
  const SurfaceExtent extent = extent_of(part);
  const double cells = cells_for_surface(extent.area, extent.thin_share, run.plan.whole.spacing,
                                         run.choice.parameters.accuracy);
  return {cells, prepared.image.low, prepared.image.high};
}

/// The fields on the first grid of some slices.
struct SlabFields {
  GridWindow window;
  std::vector<float> f;
  Iteration record;
};

SlabFields minimise_on_slices(const SlabRun& run, Prepared prepared, const Slices& slices) {
  const RunInput input(prepared);
  SlabFields fields;
  GridPass found = minimise_on_grid({input, 1, silent_stage(), fields.record});
  GridWindow& window = fields.window;
  window.box = {{0, 0, run.plan.height_of_slice(slices.begin)}, run.plan.box().hi};
  window.box.hi.z = run.plan.height_of_slice(slices.end - 1);
  window.size = found.grid.size;
  const auto image = found.image(input);
  fields.f.assign(image.begin(), image.end());
  window.u = std::move(found.minimum.u);
  window.v = std::move(found.minimum.v);
  return fields;
}

SlabFields read_fields(const SlabRun& run, Index s) {
  ArchiveReader archive = run.scratch.read(fields_file(s));
  SlabFields fields;
  fields.window = next_window(archive);
  fields.f = archive.next<float>();
  fields.record = archive.next_one<Iteration>();
  return fields;
}

Box box_of_slab(const SlabPlan& plan, Index s) {
  Box box = plan.box();
  box.lo.z = plan.height(s);
  box.hi.z = plan.height(s + 1);
  return box;
}

/// The integral of sqrt(det M) over a grid.
double complexity_of(const KuhnGrid& grid, const std::vector<PackedSym3>& log_metrics) {
  const GridMass mass(grid);
  return parallel_sum(log_metrics.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t n = begin; n < end; ++n) {
      sum += mass.at(n) * std::exp(trace(unpack(log_metrics[n])) / 2);
    }
    return sum;
  });
}

/// Bricks of less than a slab's inner part, in the same columns in every slab, so that slabs fit.
/// Their faces at the borders stay in the first mesh: larger ones would be far from what it needs.
TetMesh start_mesh(const MeshRun& run, Index s) {
  const SlabPlan& plan = run.slabs.plan;
  const double size =
      std::min(run.input.parameters.h_max, (plan.thinnest() - 2 * plan.overlap) / 1.5);
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

SlabWork prepare_and_minimise(const SlabRun& run, Index s) {
  const SlabPlan& plan = run.plan;
  const double voxel = plan.whole.voxel_size() / plan.unit_mm;
  const Slices held = slices_of(plan, s, plan.slices_in(kReach * voxel));
  Prepared prepared = prepare_slab(read_slab(run.source, held.begin, held.count()), run.choice);
  write_spline(run, s, prepared.image, held);
  ArchiveWriter extent;
  extent.add_one(extent_in(run, s, prepared, held));

  const Slices seen = slices_of(plan, s, plan.slices_in(plan.overlap));
  Prepared part{prepared.parameters, prepared.measured, cut_out(prepared.grey, held, seen), {}};
  prepared = {};
  const SlabFields fields = minimise_on_slices(run, std::move(part), seen);
  ArchiveWriter archive;
  add_window(archive, fields.window);
  archive.add(fields.f);
  archive.add_one(fields.record);
  run.scratch.write(fields_file(s), archive);
  run.scratch.write(extent_file(s), extent);
  const auto slice = static_cast<std::int64_t>(plan.whole.offset(0, 0, 1));
  return {slice * held.count(), fields.record.nodes, 0,
          (held.count() - slices_of(plan, s, 0).count()) * slice *
              static_cast<std::int64_t>(sizeof(float))};
}

std::vector<SlabExtent> extents_of(const SlabRun& run) {
  std::vector<SlabExtent> extents;
  extents.reserve(static_cast<std::size_t>(run.plan.count()));
  for (Index s = 0; s < run.plan.count(); ++s) {
    extents.push_back(run.scratch.read(extent_file(s)).next_one<SlabExtent>());
  }
  return extents;
}

Iteration grid_record(const SlabRun& run, Index s) {
  return run.scratch.read(record_file(s)).next_one<Iteration>();
}

void remove_grid_files(const SlabRun& run, Index s) { run.scratch.remove(fields_file(s)); }

SlabWork first_mesh(const MeshRun& run, Index s) {
  const SlabPlan& plan = run.slabs.plan;
  SlabFields fields = read_fields(run.slabs, s);
  GridWindow& window = fields.window;
  const KuhnGrid grid = grid_of(window);
  const Parameters& p = run.input.parameters;
  const double around = window.box.extent().z / box_of_slab(plan, s).extent().z;
  const double cells = static_cast<double>(run.input.cells_after(1)) *
                       run.shares[static_cast<std::size_t>(s)] * around;
  // Where nothing is to be seen, cells of the largest size: no bound at all would mesh the noise.
  const double fewest = window.box.volume() / std::pow(p.h_max, 3);
  const SizeControl control{p.h_min, p.h_max, std::max(fewest, cells / kCellsPerComplexity)};
  window.log_metrics = grid_log_metric({run.input, 1, silent_stage(), fields.record}, grid,
                                       {window.u, window.v, fields.f}, control);
  for (const Side side : {Side::kLow, Side::kHigh}) {
    if (!has_neighbour(plan, s, side)) continue;
    const double border = border_of(plan, s, side);
    ArchiveWriter archive;
    add_window(archive,
               slices_between(window, border - 3 * plan.overlap, border + 3 * plan.overlap));
    run.slabs.scratch.write(window_file(1, s, side), archive);
  }
  ArchiveWriter record;
  record.add_one(fields.record);
  run.slabs.scratch.write(record_file(s), record);
  const double complexity = complexity_of(grid, window.log_metrics) / around;
  const GridBackground background(std::move(window));
  return hand_on(run, 1, s, adapted(run, 1, start_mesh(run, s), background, complexity));
}

}  // namespace mesamis::detail
