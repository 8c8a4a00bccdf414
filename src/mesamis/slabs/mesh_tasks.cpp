// SPDX-License-Identifier: Apache-2.0
// The tasks on meshes.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/fem/mesh_space.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/remesh/piece.h"
#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/mesh_files.h"
#include "mesamis/slabs/records.h"
#include "mesamis/slabs/tasks.h"

namespace mesamis::detail {
namespace {

std::string file_of(const char* what, int k, Index s) {
  return std::string(what) + "." + std::to_string(k) + "." + std::to_string(s);
}
std::string side_file(const char* what, int k, Index s, Side side) {
  return file_of(what, k, s) + (side == Side::kLow ? ".low" : ".high");
}

void write_piece(const Scratch& scratch, const std::string& name, const Piece& piece) {
  ArchiveWriter archive;
  add_piece(archive, piece);
  scratch.write(name, archive);
}

/// @param work  optional: where the bytes of another slab are counted.
Piece read_piece(const Scratch& scratch, const std::string& name, SlabWork* work = nullptr) {
  ArchiveReader archive = scratch.read(name);
  if (work != nullptr) work->bytes += static_cast<std::int64_t>(archive.size());
  return next_piece(archive);
}

std::unique_ptr<Background> read_background(const Scratch& scratch, int k, Index s, Side side) {
  ArchiveReader archive = scratch.read(window_file(k, s, side));
  if (k == 1) return stack(next_windows(archive));
  return std::make_unique<MeshBackground>(next_piece(archive));
}

/// Mesh k as slab s sees it: its own cells, and those around.
struct LocalMesh {
  Piece piece;
  std::vector<std::uint8_t> own;  ///< per cell
};

Piece join_all(const std::vector<Piece>& pieces) {
  std::vector<const Piece*> pointers(pieces.size());
  std::transform(pieces.begin(), pieces.end(), pointers.begin(),
                 [](const Piece& piece) { return &piece; });
  return join(pointers);
}

LocalMesh read_local(const MeshRun& run, int k, Index s, SlabWork& work) {
  const SlabPlan& plan = run.plan;
  const Scratch& scratch = run.slabs.scratch;
  std::vector<Piece> parts{read_piece(scratch, file_of("core", k, s))};
  LocalMesh local;
  const auto add = [&](Piece part, const auto& is_own) {
    for (const Cell& cell : part.mesh.cells) local.own.push_back(is_own(part, cell) ? 1 : 0);
    parts.push_back(std::move(part));
  };
  const auto all = [](const Piece&, const Cell&) { return true; };
  const auto none = [](const Piece&, const Cell&) { return false; };
  local.own.assign(parts[0].mesh.cells.size(), 1);
  for (const Side side : {Side::kLow, Side::kHigh}) {
    if (!has_neighbour(plan, s, side)) continue;
    const bool low = side == Side::kLow;
    const double border = border_of(plan, s, side);
    add(read_piece(scratch, side_file("rim", k, s, side)), all);
    add(read_piece(scratch, file_of("seam", k, low ? s - 1 : s), low ? &work : nullptr),
        [&](const Piece& part, const Cell& cell) {
          return (height_of(part.mesh, cell) < border) != low;
        });
    add(read_piece(scratch, side_file("rim", k, low ? s - 1 : s + 1, opposite(side)), &work), none);
  }
  local.piece = join_all(parts);
  return local;
}

/// Removes what slab s needed for mesh k and what led to it. Only a later stage does so: a task
/// that is done again needs its files.
void remove_files_before(const MeshRun& run, int k, Index s) {
  if (k == 1) return remove_grid_files(run.slabs, s);
  const Scratch& scratch = run.slabs.scratch;
  for (const char* what : {"core", "seam", "solved"}) scratch.remove(file_of(what, k - 1, s));
  for (const Side side : {Side::kLow, Side::kHigh}) {
    for (const char* what : {"border", "rim"}) scratch.remove(side_file(what, k - 1, s, side));
    scratch.remove(window_file(k - 1, s, side));
  }
}

Piece own_part(const LocalMesh& local) {
  const Cell* first = local.piece.mesh.cells.data();
  return select(local.piece, [&](const Cell& cell) {
    return local.own[static_cast<std::size_t>(&cell - first)] != 0;
  });
}

/// Minimises on a local mesh, from what the mesh before left, and writes the fields to its nodes.
Minimum minimise_on(const MeshRun& run, int k, const AmisOptions& options, Piece& piece,
                    Iteration& record) {
  Guess guess{values_of(piece, &NodeValues::u), values_of(piece, &NodeValues::v)};
  Minimum m =
      minimise({run.input, k, silent_stage(), record}, piece.mesh, std::move(guess), options);
  for (std::size_t n = 0; n < piece.nodes.size(); ++n) {
    NodeValues& node = piece.nodes[n];
    node.u = m.u[n];
    node.v = m.v[n];
    node.f = m.f[n];
  }
  return m;
}

/// How far from a border cells are adapted again, in overlaps: farther, and more is done twice.
constexpr double kSeam = 0.5;

/// Of the logarithm of the first mesh's number of cells.
constexpr double kSlackOfFirstMesh = 0.05;

/// A piece may have so many cells at least.
constexpr std::int64_t kFewestInPiece = 1000;

/// What all slabs tell each other of a mesh, to choose the sizes of the next one together.
constexpr std::size_t kFactors = 97;
struct Profile {
  std::array<double, kFactors> complexity{};  ///< of the own nodes, for each of factors()
  double cells = 0;                           ///< own
  Profile& operator+=(const Profile& other) {
    for (std::size_t i = 0; i < kFactors; ++i) complexity[i] += other.complexity[i];
    cells += other.cells;
    return *this;
  }
};

std::vector<double> factors() {
  constexpr double kMost = 12;  // of the logarithm
  std::vector<double> all(kFactors);
  for (std::size_t i = 0; i < kFactors; ++i) {
    all[i] = std::exp(kMost * static_cast<double>(i) / (kFactors - 1));
  }
  return all;
}

/// What was recorded of the minimisation on a mesh that is not the last.
Iteration mesh_record(const MeshRun& run, int k, Index s) {
  ArchiveReader archive = run.slabs.scratch.read(file_of("profile", k, s));
  archive.next_one<Profile>();
  return archive.next_one<Iteration>();
}

Profile sum_of_profiles(const MeshRun& run, int k) {
  Profile sum;
  for (Index s = 0; s < run.plan.count(); ++s) {
    sum += run.slabs.scratch.read(file_of("profile", k, s)).next_one<Profile>();
  }
  return sum;
}

/// The factor by which all sizes are multiplied to bring the complexity to a bound.
double factor_for(const Profile& profile, double bound) {
  const std::vector<double> all = factors();
  const auto& c = profile.complexity;
  if (c[0] <= bound) return 1;
  std::size_t i = 1;
  while (i + 1 < kFactors && c[i] > bound) ++i;
  const double share = std::log(c[i - 1] / bound) / std::log(c[i - 1] / c[i]);
  return all[i - 1] * std::pow(all[i] / all[i - 1], std::min(share, 1.0));
}

/// The factor for the sizes of mesh k + 1. The remesher's cells per unit of complexity are taken to
/// be those that mesh k was measured to have.
double next_factor(const MeshRun& run, int k) {
  double complexity = static_cast<double>(run.input.cells_after(1)) / kCellsPerComplexity;
  Profile profile;
  for (int mesh = 1; mesh <= k; ++mesh) {
    profile = sum_of_profiles(run, mesh);
    const double per_complexity = std::clamp(profile.cells / complexity, 4.0, 20.0);
    complexity = static_cast<double>(run.input.cells_after(mesh + 1)) / per_complexity;
  }
  return factor_for(profile, complexity);
}

/// Bounds the sizes of the metrics at the nodes, and so the number of cells of mesh k + 1.
void control_metric(const MeshRun& run, int k, Piece& piece) {
  const Parameters& p = run.input.parameters;
  const double factor = next_factor(run, k);
  std::vector<Sym3> metric = values_of(piece, &NodeValues::metric);
  for (Sym3& m : metric) m = (1 / (factor * factor)) * m;
  const std::vector<double> weights(metric.size(), 1);
  control_sizes(metric, weights, {p.h_min, p.h_max, 0});
  for (std::size_t n = 0; n < metric.size(); ++n) piece.nodes[n].metric = metric[n];
}

/// The record of a pass, as far as it is the slab's own, to be added up.
/// @param own  the part of the local mesh that is the slab's.
void record_own(const MeshRun& run, const Piece& own, Iteration& record) {
  const std::vector<double> u = values_of(own, &NodeValues::u);
  const std::vector<double> v = values_of(own, &NodeValues::v);
  const std::vector<double> f = values_of(own, &NodeValues::f);
  record.tets = std::ssize(own.mesh.cells);
  record.nodes = std::ssize(own.mesh.points);
  record.energy = energy(MeshSpace(own.mesh), run.input.parameters.functional, {u, v, f});
}

}  // namespace

const Stage& silent_stage() {
  static const Progress silent;
  static const Stage stage(silent, "");
  return stage;
}

std::string window_file(int k, Index s, Side side) { return side_file("window", k, s, side); }

Piece adapted(const MeshRun& run, int k, const TetMesh& start, const Background& background,
              double complexity) {
  // Only a guard: a border that stays needs cells whatever the metric asks for, and a bound that
  // cannot be kept would make all cells coarser, also those at the surface.
  constexpr double kMost = 2 * kCellsPerComplexity;
  RemeshOptions options;
  options.max_cells = std::llround(kMost * complexity) + std::ssize(start.cells) + kFewestInPiece;
  options.draft = run.input.cells_after(k) < run.input.parameters.max_tets;
  Piece piece{remesh_piece(start, run.plan.box(), background, options), {}};
  piece.nodes = background.values(piece.mesh.points);
  return piece;
}

SlabWork hand_on(const MeshRun& run, int k, Index s, const Piece& mesh) {
  const SlabPlan& plan = run.plan;
  // A cell that is near both borders belongs to the lower one.
  const auto side_of = [&](const Piece& piece, const Cell& cell,
                           double distance) -> std::optional<Side> {
    for (const Side side : {Side::kLow, Side::kHigh}) {
      if (has_neighbour(plan, s, side) &&
          is_near(piece.mesh, cell, border_of(plan, s, side), distance)) {
        return side;
      }
    }
    return std::nullopt;
  };
  // Writes what is near the borders, and returns the rest.
  const auto cut_off = [&](const char* what, const Piece& piece, double distance) {
    const auto part = [&](std::optional<Side> wanted) {
      return select(
          piece, [&](const Cell& cell) { return side_of(piece, cell, distance) == wanted; });
    };
    for (const Side side : {Side::kLow, Side::kHigh}) {
      if (!has_neighbour(plan, s, side)) continue;
      write_piece(run.slabs.scratch, side_file(what, k, s, side), part(side));
    }
    return part(std::nullopt);
  };
  const Piece inner = cut_off("border", mesh, kSeam * plan.overlap);
  write_piece(run.slabs.scratch, file_of("core", k, s), cut_off("rim", inner, plan.overlap));
  return {.cells = std::ssize(mesh.mesh.cells)};
}

MeshRun::MeshRun(const SlabRun& run)
    : slabs(run),
      prepared{run.choice.parameters, run.choice.measured, {}, {}},
      input(prepared),
      grid(grid_slabs(run)) {
  const VoxelGrid& whole = run.plan.whole;
  double cells = 0;
  std::vector<double> complexities;  // of the slices
  for (const GridSlab& slab : grid) {
    cells += slab.extent.cells;
    complexities.insert(complexities.end(), slab.complexities.begin(), slab.complexities.end());
  }
  Parameters& p = prepared.parameters;
  plan = plan_slabs(whole, complexities, {p.unit_mm, p.functional.beta, run.plan.count()});
  const double all = std::accumulate(complexities.begin(), complexities.end(), 0.0);
  for (Index s = 0; s < plan.count(); ++s) {
    const auto at = static_cast<std::size_t>(s);
    shares.push_back(std::accumulate(complexities.begin() + plan.cuts[at],
                                     complexities.begin() + plan.cuts[at + 1], 0.0) /
                     all);
  }
  if (p.max_tets == 0) {
    p.max_tets = std::llround(
        std::clamp<double>(cells, kFewestTets, static_cast<double>(kMostTets) * plan.count()));
  }
  // Where the slabs were too rough a guess, or the bounds above act.
  const double asked = static_cast<double>(input.cells_after(1)) / kCellsPerComplexity;
  if (std::abs(std::log(all / asked)) > kSlackOfFirstMesh) first_factor = std::cbrt(all / asked);
  static_cast<VoxelGrid&>(prepared.grey) = whole;
  auto mapped = map_items<float>(run.scratch.path(kImageFile), whole.voxel_count());
  prepared.image = {whole, mapped.values, grid[0].extent.low, grid[0].extent.high, mapped.owner};
  input.box = plan.box();
}

SlabWork seam(const MeshRun& run, int k, Index s) {
  const Scratch& scratch = run.slabs.scratch;
  SlabWork work;
  const Piece below = read_piece(scratch, side_file("border", k, s, Side::kHigh));
  const Piece above = read_piece(scratch, side_file("border", k, s + 1, Side::kLow), &work);
  const std::array<const Piece*, 2> both{&below, &above};
  std::vector<std::unique_ptr<Background>> sides;
  sides.push_back(read_background(scratch, k, s, Side::kHigh));
  sides.push_back(read_background(scratch, k, s + 1, Side::kLow));
  const StackedBackground background(std::move(sides), {run.plan.height(s + 1)});
  const TetMesh start = join(both).mesh;
  const double needed = complexity(start, sample(background, start.points));
  const Piece piece = adapted(run, k, start, background, needed);
  write_piece(scratch, file_of("seam", k, s), piece);
  work.cells = std::ssize(piece.mesh.cells);
  return work;
}

SlabWork solve(const MeshRun& run, int k, Index s) {
  remove_files_before(run, k, s);
  SlabWork work;
  LocalMesh local = read_local(run, k, s, work);
  Piece& piece = local.piece;
  const std::vector<double> before = values_of(piece, &NodeValues::u);
  Iteration record;
  const Minimum m = minimise_on(run, k + 1, run.input.draft_options(), piece, record);
  work.rows = record.nodes;
  const Pass pass{run.input, k + 1, silent_stage(), record};
  record_surface(pass, piece.mesh, before, m.u);
  const std::vector<Sym3> metric = asked_metric(pass, piece.mesh, m, run.input.cells_after(k));
  for (std::size_t n = 0; n < metric.size(); ++n) piece.nodes[n].metric = metric[n];
  const std::vector<double> mass = lumped_mass_of(piece.mesh, local.own);
  const Parameters& p = run.input.parameters;
  const auto complexities = clamped_complexities(metric, mass, {p.h_min, p.h_max, 0}, factors());
  Profile profile;
  std::copy(complexities.begin(), complexities.end(), profile.complexity.begin());
  record_own(run, own_part(local), record);
  profile.cells = static_cast<double>(record.tets);

  ArchiveWriter solved, told;
  add_piece(solved, piece);
  solved.add(local.own);
  told.add_one(profile);
  told.add_one(record);
  run.slabs.scratch.write(file_of("solved", k, s), solved);
  run.slabs.scratch.write(file_of("profile", k, s), told);
  return work;
}

SlabWork adapt_slab(const MeshRun& run, int k, Index s) {
  const SlabPlan& plan = run.plan;
  const Scratch& scratch = run.slabs.scratch;
  LocalMesh local;
  {
    ArchiveReader archive = scratch.read(file_of("solved", k, s));
    local.piece = next_piece(archive);
    local.own = archive.next<std::uint8_t>();
  }
  control_metric(run, k, local.piece);
  for (const Side side : {Side::kLow, Side::kHigh}) {
    if (!has_neighbour(plan, s, side)) continue;
    const double border = border_of(plan, s, side);
    write_piece(scratch, window_file(k + 1, s, side), select(local.piece, [&](const Cell& cell) {
                  return is_near(local.piece.mesh, cell, border, 3 * plan.overlap);
                }));
  }
  const Piece own = own_part(local);
  const MeshBackground background(std::move(local.piece));
  const double needed = complexity(own.mesh, values_of(own, &NodeValues::metric));
  return hand_on(run, k + 1, s, adapted(run, k + 1, own.mesh, background, needed));
}

SlabWork finish(const MeshRun& run, int k, Index s) {
  remove_files_before(run, k, s);
  SlabWork work;
  LocalMesh local = read_local(run, k, s, work);
  const std::vector<double> before = values_of(local.piece, &NodeValues::u);
  Iteration record;
  const Minimum m = minimise_on(run, k, run.input.final_options(), local.piece, record);
  work.rows = record.nodes;
  record_surface({run.input, k, silent_stage(), record}, local.piece.mesh, before, m.u);
  const Piece own = own_part(local);
  record_own(run, own, record);
  ArchiveWriter archive;
  add_piece(archive, own);
  archive.add_one(record);
  run.slabs.scratch.write(file_of("final", k, s), archive);
  return work;
}

std::vector<Iteration> records_of(const MeshRun& run, int k) {
  std::vector<Iteration> passes, records;
  std::vector<double> equal;
  for (const GridSlab& slab : run.grid) {
    records.push_back(slab.record);
    equal.push_back(1.0 / run.plan.count());
  }
  passes.push_back(sum_of_records(records, equal));
  for (int mesh = 1; mesh <= k; ++mesh) {
    for (Index s = 0; s < run.plan.count(); ++s) {
      records[static_cast<std::size_t>(s)] = mesh_record(run, mesh, s);
    }
    passes.push_back(sum_of_records(records, run.shares));
  }
  return passes;
}

Finished collect(const MeshRun& run, int k) {
  Finished finished;
  finished.passes = records_of(run, k - 1);
  std::vector<Piece> pieces;
  std::vector<Iteration> records;
  for (Index s = 0; s < run.plan.count(); ++s) {
    ArchiveReader archive = run.slabs.scratch.read(file_of("final", k, s));
    pieces.push_back(next_piece(archive));
    records.push_back(archive.next_one<Iteration>());
  }
  finished.passes.push_back(sum_of_records(records, run.shares));
  finished.whole = join_all(pieces);
  return finished;
}

}  // namespace mesamis::detail
