// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/run_in_slabs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/base/written_number.h"
#include "mesamis/decimate/round_to_single.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/sample_slices.h"
#include "mesamis/method/chosen_run.h"
#include "mesamis/method/deliver.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/slabs/in_scratch.h"
#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/stages.h"
#include "mesamis/slabs/surface_files.h"
#include "mesamis/slabs/surface_tasks.h"
#include "mesamis/slabs/tasks.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis::detail::slabs {
namespace {

/// Slices that are looked at together before there is a plan.
constexpr Index kChunk = 16;

std::string sums_file(Index chunk) { return "sums." + std::to_string(chunk); }

Volume read_chunk(const SliceSource& source, Index chunk) {
  const Index first = chunk * kChunk;
  return read_slab(source, first, std::min(kChunk, source.grid().size[2] - first));
}

/// The object as a run of one machine would take it.
ChosenObject choose_in(Volume scan, const Settings& settings) {
  require_usable(scan);
  return choose_object(std::move(scan), object_request(settings));
}

/// The slices that stand for the scan.
/// @param most  voxels of them.
SliceRange slices_to_look_at(const SliceSource& source, std::size_t most, const Scratch& scratch,
                             Stages& stages) {
  const VoxelGrid& whole = source.grid();
  if (whole.voxel_count() <= most) return {0, whole.size[2]};
  const Index chunks = (whole.size[2] + kChunk - 1) / kChunk;
  stages.run("look", chunks, [&](Index c) {
    ArchiveWriter archive;
    archive.add(sums_of_slices(read_chunk(source, c)));
    scratch.write(sums_file(c), archive);
    return SlabWork{};
  });
  std::vector<SliceSums> all;
  for (Index c = 0; c < chunks; ++c) {
    const auto some = scratch.read(sums_file(c)).next<SliceSums>();
    all.insert(all.end(), some.begin(), some.end());
  }
  return sample_slices(whole, all, most);
}

/// The plan if all slices are equal work, as on a grid.
SlabPlan even_plan(const VoxelGrid& whole, const SlabOptions& options) {
  const std::vector<double> equal(static_cast<std::size_t>(whole.size[2]), 1);
  return plan_slabs(whole, equal, options);
}

/// The file of SlabRun::excess.
constexpr const char* kExcessFile = "excess";

/// Chooses the parameters and cuts the scan: what must be known before slabs can be worked on.
/// @param options  whose number of slabs is told.
SlabRun begin_run(const SliceSource& source, const Settings& settings,
                  const SlabRunOptions& options, const Scratch& scratch, Stages& stages) {
  const VoxelGrid& whole = source.grid();
  const SliceRange sample = slices_to_look_at(source, options.most_looked_at, scratch, stages);
  stages.run("choose", 1, [&](Index) {
    const ChosenObject object = choose_in(read_slab(source, sample.first, sample.count), settings);
    ImageSettings chosen = settings_for(object, settings);
    const bool is_too_large = sample.count < whole.size[2] && chosen.asked.has_local_level() &&
                              is_hounsfield(object.volume);
    if (is_too_large) chosen.asked.local_level = false;
    const ChosenImage found = choose_from_part(object.volume, whole, chosen);
    if (found.chosen.measured.has_local_levels()) {
      make_item_file<float>(scratch.path(kExcessFile), whole.voxel_count());
      write_items<float>(scratch.path(kExcessFile), 0, found.excess.samples);
    }
    ArchiveWriter archive;
    archive.add_one(found.chosen);
    archive.add_one(static_cast<char>(is_too_large));
    scratch.write("choice", archive);
    return SlabWork{};
  });
  ArchiveReader archive = scratch.read("choice");
  auto choice = archive.next_one<Chosen>();
  Parameters& p = choice.parameters;
  const SlabPlan plan = even_plan(whole, {p.unit_mm, p.functional.beta, options.slabs});
  p.h_max = std::max(p.h_min, std::min(p.h_max, plan.least_thickness()));
  MappedItems<float> excess;
  if (choice.measured.has_local_levels()) {
    excess = map_items<float>(scratch.path(kExcessFile), whole.voxel_count());
  }
  return {source, scratch, plan, choice, excess, archive.next_one<char>() != 0};
}

std::string of_mesh(const char* what, int k) { return what + (" " + std::to_string(k)); }

/// All tasks on meshes: as many meshes as run_loop() would make.
/// @return the number of the last mesh.
int run_meshes(MeshRun& run, Stages& stages) {
  const Index slabs = run.count();
  stages.for_slabs("mesh 1", slabs, [&](Index s) { return first_mesh(run, s); });
  stages.for_borders("borders 1", slabs, [&](Index s) { return seam(run, 1, s); });
  int k = 1;
  for (bool settled = false; k < run.input.parameters.adaptations && !settled; ++k) {
    stages.for_slabs(of_mesh("minimise", k), slabs, [&](Index s) { return solve(run, k, s); });
    plan_next_mesh(run);
    stages.for_slabs(of_mesh("mesh", k + 1), slabs,
                     [&](Index s) { return adapt_slab(run, k + 1, s); });
    stages.for_borders(of_mesh("borders", k + 1), slabs,
                       [&](Index s) { return seam(run, k + 1, s); });
    settled = has_settled(run.input, records_of(run, k));
  }
  stages.for_slabs("final minimisation", slabs, [&](Index s) { return finish(run, k, s); });
  return k;
}

/// All tasks on the surface.
void run_surface(SurfaceRun& run, Stages& stages, bool grey) {
  const Index slabs = run.count();
  Parameters& p = run.parameters;
  stages.for_slabs("surface", slabs, [&](Index s) { return extract_slab(run, s); });
  learn_follows(run);
  stages.for_slabs("follow", slabs, [&](Index s) { return follow_slab(run, s); });
  stages.for_borders("follow at borders", slabs, [&](Index s) { return follow_border(run, s); });
  stages.for_slabs("parts", slabs, [&](Index s) { return list_parts(run, s); });
  learn_parts(run);
  choose_tolerance(p, run.mesh.input.grey.voxel_size(), run.parts.mean_error, kErrorsOfDecimation);
  if (!decimates_in_slabs(run)) return;
  stages.for_slabs("nesting", slabs, [&](Index s) { return cross_rays(run, s); });
  learn_choice(run, {p.min_volume, p.keep_largest, p.fill_cavities});
  stages.for_slabs("decimate", slabs, [&](Index s) { return decimate_slab(run, s); });
  stages.for_borders("decimate at borders", slabs,
                     [&](Index s) { return decimate_border(run, s); });
  stages.for_slabs("distances", slabs, [&](Index s) { return measure_slab(run, s); });
  if (grey) stages.for_slabs("grey", slabs, [&](Index s) { return find_grey(run, s); });
}

Loop loop_on(Piece whole) {
  Loop loop;
  loop.minimum.f = values_of(whole, &NodeValues::f);
  loop.minimum.u = values_of(whole, &NodeValues::u);
  loop.minimum.v = values_of(whole, &NodeValues::v);
  loop.state.metric = values_of(whole, &NodeValues::metric);
  loop.state.mesh = std::move(whole.mesh);
  return loop;
}

/// What the loop leaves.
/// @param whole  its mesh; empty if nobody wants it.
Loop loop_of(const SurfaceRun& run, Piece whole) {
  Loop loop = loop_on(std::move(whole));
  loop.passes = records_of(run.mesh, run.last);
  for (std::size_t pass = 1; pass < loop.passes.size(); ++pass) {
    Iteration& now = loop.passes[pass];
    const Iteration& before = loop.passes[pass - 1];
    now.energy_change =
        std::abs(now.energy.total() - before.energy.total()) / before.energy.total();
  }
  std::vector<Iteration> adaptations(loop.passes.begin(), loop.passes.end() - 1);
  loop.settled = adaptations.size() > 1 && has_settled(run.mesh.input, adaptations);
  return loop;
}

/// As if the whole scan had one; those of the slabs overlap.
std::int64_t nodes_of_first_grid(const MeshRun& run) {
  const auto size = first_grid_size(run.slabs.plan.whole.size, run.input.parameters.stride);
  return std::int64_t{size[0]} * size[1] * size[2];
}

/// The surface that the slabs have decimated.
/// @return whether it is one to deliver: not where pieces of a dense surface have come to meet, or
///         where points had to be joined that are too far from each other.
bool take_decimated(const SurfaceRun& run, Result& result) {
  if (!decimates_in_slabs(run)) return false;
  TriMesh surface = decimated_surface(run);
  turn_as_grid(run.mesh.input, surface);
  RoundReport rounding;
  result.surface = round_to_single(surface, &rounding);
  if (!find_self_intersections(result.surface).empty()) return false;
  result.printable = printable_report(run);
  result.printable.extracted_to_result += rounding.shift;
  result.printable.result_to_extracted += rounding.shift;
  tell_error(run.mesh.input, result);
  return std::max(result.printable.extracted_to_result, result.printable.result_to_extracted) <=
         *run.parameters.tolerance;
}

/// The surface as it is delivered, and what is known of it.
/// @return whether it is what the slabs have decimated; else all of it was finished at once.
bool deliver_surface_of(const SurfaceRun& run, const Progress& progress, Result& result) {
  if (take_decimated(run, result)) return true;
  result.surface = followed_surface(run);
  turn_as_grid(run.mesh.input, result.surface);
  finish_surface(run.mesh.input, progress, result);
  return false;
}

/// Hands the mesh out, slab by slab.
void hand_out_pieces(const SurfaceRun& run, const SlabRunOptions& options) {
  if (!options.take_piece) return;
  for (Index s = 0; s < run.count(); ++s) {
    SlabWork uncounted;
    Result piece;
    piece.parameters = run.parameters;
    deliver_mesh(run.mesh.input, loop_on(final_mesh(run, s, uncounted)), piece);
    options.take_piece(s, piece);
  }
}

void drop_mesh(Result& result) {
  result.mesh = {};
  result.u = result.v = result.f = {};
  result.metric = {};
}

SlabRunResult deliver(const SurfaceRun& run, const SlabRunOptions& options, const Stages& stages) {
  const MeshRun& mesh = run.mesh;
  SlabRunResult all;
  Result& result = all.result;
  result.parameters = run.parameters;
  result.image = mesh.prepared.measured;
  Stopwatch watch;
  const bool in_slabs = deliver_surface_of(run, options.progress, result);
  result.seconds.printable = watch.lap();
  // Of the whole surface, the grey values come from the whole mesh.
  const bool needs_mesh = options.mesh || (options.grey && !in_slabs);
  Loop loop = loop_of(run, needs_mesh ? collect(mesh, run.last) : Piece{});
  all.own_rows = nodes_of_first_grid(mesh);
  for (std::size_t pass = 1; pass < loop.passes.size(); ++pass) {
    all.own_rows += loop.passes[pass].nodes;
    all.own_cells += loop.passes[pass].tets;
  }
  deliver_mesh(mesh.input, std::move(loop), result);
  if (!needs_mesh) result.fit = fit_of(mesh, run.last);
  if (options.grey) {
    all.grey = in_slabs ? grey_of(run, result.surface)
                        : surface_grey(result, mesh.slabs.plan.whole.voxel_size());
  }
  if (!options.mesh) drop_mesh(result);
  hand_out_pieces(run, options);
  all.is_too_large = mesh.slabs.is_too_large;
  all.plan = mesh.slabs.plan;
  all.mesh_plan = mesh.plan(run.last);
  all.slabs = stages.work_of_slabs(run.count());
  return all;
}

void require_possible(const Settings& settings, const SlabRunOptions& options) {
  require_valid(settings);
  require_turns(options);
  if (settings.preview) throw InputError("slabs: expected a run with meshes, found a preview");
  if (!(settings.crop == CropRange{})) {
    throw InputError("slabs: expected the whole scan, found a crop");
  }
  if (settings.until != StopRule::kSurface) {
    throw InputError("slabs: expected a run until the surface has settled, found until energy");
  }
  if (settings.surface != SurfaceKind::kSolid) {
    throw InputError("slabs: expected a run that finds a solid, found the band of an edge");
  }
}

/// A number that tells the samples of a slice from others (FNV-1a).
std::uint64_t hash_of_slice(const SliceSource& source, Index k) {
  std::uint64_t hash = 14695981039346656037U;
  for (const float sample : source.read(k, 1)) {
    hash = (hash ^ std::bit_cast<std::uint32_t>(sample)) * 1099511628211U;
  }
  return hash;
}

/// What a folder of scratch files belongs to: files of another run would be taken for its own. Of
/// the samples only those of the middle slice count: the scan is large.
std::string description_of_run(const SliceSource& source, const Settings& settings,
                               const SlabRunOptions& options, Index slabs) {
  const VoxelGrid& grid = source.grid();
  std::string text = description_of(settings) + " " + options.input + " slabs " +
                     std::to_string(slabs) + " looked at " + std::to_string(options.most_looked_at);
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<int>(a);
    text += " " + std::to_string(grid.size[a]);
    for (const double number : {grid.spacing[axis], grid.origin[axis], grid.direction.rows[a].x,
                                grid.direction.rows[a].y, grid.direction.rows[a].z}) {
      text += " " + number_text(number);
    }
  }
  return text + " samples " + std::to_string(hash_of_slice(source, grid.size[2] / 2));
}

/// One slab is the whole scan: a run like any other.
SlabRunResult run_whole(const SliceSource& source, const Settings& settings, SlabPlan plan,
                        const SlabRunOptions& options) {
  const ChosenObject object = choose_in(read_slab(source, 0, plan.whole.size[2]), settings);
  SlabRunResult all;
  all.result = run_on_object(object, settings, options.progress);
  if (options.grey) all.grey = surface_grey(all.result, source.grid().voxel_size());
  all.plan = all.mesh_plan = std::move(plan);
  for (const Iteration& pass : all.result.iterations) {
    all.own_rows += pass.nodes;
    if (&pass != &all.result.iterations.front()) all.own_cells += pass.tets;
  }
  if (options.take_piece) options.take_piece(0, all.result);
  if (!options.mesh) drop_mesh(all.result);
  all.slabs = {
      {static_cast<std::int64_t>(all.plan.whole.voxel_count()), all.own_rows, all.own_cells, 0}};
  return all;
}

std::optional<SlabRunResult> run_through(const Scratch& scratch, const SliceSource& source,
                                         const Settings& settings, const SlabRunOptions& options,
                                         const SlabPlan& even, Team& team) {
  const Progress& progress = options.progress;
  const VoxelGrid& whole = source.grid();
  if (even.count() == 1) {
    if (team.rank() != 0) return std::nullopt;
    return run_whole(source, settings, even, options);
  }
  Stages stages(scratch, team, progress,
                options.turns.value_or(slabs::parts_of(whole, kVoxelsOfATurn)));
  SlabRunOptions planned = options;
  planned.slabs = even.count();
  const SlabRun run = begin_run(source, settings, planned, scratch, stages);
  stages.run("image", 1, [&](Index) {
    make_item_file<float>(scratch.path(kImageFile), run.plan.whole.voxel_count());
    return SlabWork{};
  });
  stages.for_slabs("prepare", run.plan.count(),
                   [&](Index s) { return prepare_and_minimise(run, s); });
  MeshRun meshes(run);
  SurfaceRun surface(meshes, run_meshes(meshes, stages));
  require_full(meshes, surface.last);
  run_surface(surface, stages, options.grey);
  team.wait_for_all();  // all have read what rank 0 removes at the end
  if (team.rank() != 0) return std::nullopt;
  return deliver(surface, options, stages);
}

}  // namespace

void require_turns(const SlabRunOptions& options) {
  if (options.turns.value_or(1) < 1) {
    throw InputError("slabs: expected at least 1 turn, found " + std::to_string(*options.turns));
  }
}

std::optional<SlabRunResult> run_in_slabs(const SliceSource& source, const Settings& settings,
                                          const SlabRunOptions& options, Team& team) {
  require_possible(settings, options);
  const VoxelGrid& whole = source.grid();
  // How many slabs there are depends on no sample.
  const SlabPlan even = even_plan(whole, {whole.voxel_size(), settings.beta, options.slabs});
  const std::string description = description_of_run(source, settings, options, even.count());
  return run_in_scratch(options, description, team, [&](const Scratch& scratch) {
    return run_through(scratch, source, settings, options, even, team);
  });
}

}  // namespace mesamis::detail::slabs
