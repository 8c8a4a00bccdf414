// SPDX-License-Identifier: Apache-2.0
// The tasks on meshes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/fem/mesh_space.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/remesh/piece.h"
#include "mesamis/slabs/mesh_files.h"
#include "mesamis/slabs/profile.h"
#include "mesamis/slabs/records.h"
#include "mesamis/slabs/surface_files.h"
#include "mesamis/slabs/tasks.h"

namespace mesamis::detail::slabs {
namespace {

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

/// Whose a cell is, seen from a slab.
enum class Owner : std::uint8_t { kSelf, kBelow, kAbove };

/// Mesh k as slab s sees it: its own cells, and those around.
struct LocalMesh {
  Piece piece;
  std::vector<Owner> owners;  ///< of the cells
};

LocalMesh read_local(const MeshRun& run, int k, Index s, SlabWork& work) {
  const SlabPlan& plan = run.plan(k);
  const Scratch& scratch = run.slabs.scratch;
  std::vector<Piece> parts{read_piece(scratch, file_of("core", k, s))};
  LocalMesh local;
  const auto add = [&](Owner other, Piece part, const auto& is_own) {
    for (const Cell& cell : part.mesh.cells) {
      local.owners.push_back(is_own(part, cell) ? Owner::kSelf : other);
    }
    parts.push_back(std::move(part));
  };
  const auto all = [](const Piece&, const Cell&) { return true; };
  const auto none = [](const Piece&, const Cell&) { return false; };
  local.owners.assign(parts[0].mesh.cells.size(), Owner::kSelf);
  for (const Side side : {Side::kLow, Side::kHigh}) {
    if (!has_neighbour(plan, s, side)) continue;
    const bool low = side == Side::kLow;
    const double border = border_of(plan, s, side);
    const Owner other = low ? Owner::kBelow : Owner::kAbove;
    add(other, read_piece(scratch, side_file("rim", k, s, side)), all);
    add(other, read_piece(scratch, file_of("seam", k, low ? s - 1 : s), low ? &work : nullptr),
        [&](const Piece& part, const Cell& cell) {
          return (height_of(part.mesh, cell) < border) != low;
        });
    add(other, read_piece(scratch, side_file("rim", k, low ? s - 1 : s + 1, opposite(side)), &work),
        none);
  }
  local.piece = join(parts);
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
  }
}

Piece own_part(const LocalMesh& local) {
  const Cell* first = local.piece.mesh.cells.data();
  return select(local.piece, [&](const Cell& cell) {
    return local.owners[static_cast<std::size_t>(&cell - first)] == Owner::kSelf;
  });
}

/// Of each node 1 if it is one of the slab's own cells and of those of another owner.
std::vector<char> shared_with(const LocalMesh& local, Owner other) {
  std::vector<char> own(local.piece.nodes.size(), 0), others(own);
  for (std::size_t c = 0; c < local.owners.size(); ++c) {
    if (local.owners[c] != Owner::kSelf && local.owners[c] != other) continue;
    std::vector<char>& nodes = local.owners[c] == other ? others : own;
    for (const Index node : local.piece.mesh.cells[c]) nodes[node] = 1;
  }
  for (std::size_t n = 0; n < own.size(); ++n) own[n] &= others[n];
  return own;
}

/// The nodes of a slab's part that are nodes of other slabs too: those where it ends, but for the
/// box. Of each face that has one cell.
std::vector<Index> border_nodes(const TetMesh& own, const Box& box) {
  std::vector<char> at_border(own.points.size(), 0);
  const auto neighbors = cell_neighbors(own);
  for (std::size_t c = 0; c < own.cells.size(); ++c) {
    for (std::size_t f = 0; f < 4; ++f) {
      if (neighbors[c][f] != kNoIndex) continue;
      int planes = -1;
      for (const std::size_t corner : kCellFaces[f]) {
        planes &= planes_of(box, own.points[own.cells[c][corner]]);
      }
      if (planes != 0) continue;
      for (const std::size_t corner : kCellFaces[f]) at_border[own.cells[c][corner]] = 1;
    }
  }
  std::vector<Index> nodes;
  for (std::size_t n = 0; n < at_border.size(); ++n) {
    if (at_border[n] != 0) nodes.push_back(static_cast<Index>(n));
  }
  return nodes;
}

/// Of each node of slab s at which of its borders it is. Where large cells were cut a border
/// reaches far from its height: it is the one whose height is nearer.
std::vector<std::optional<Side>> sides_of_border(const MeshRun& run, int k, Index s,
                                                 const TetMesh& own) {
  const double middle = middle_of(run.plan(k), s);
  std::vector<std::optional<Side>> sides(own.points.size());
  for (const Index node : border_nodes(own, run.input.box)) {
    sides[node] = own.points[node].z < middle ? Side::kLow : Side::kHigh;
  }
  return sides;
}

/// Writes the nodes that other slabs have too.
void write_shared_nodes(const MeshRun& run, int k, Index s, const Piece& own) {
  std::vector<Vec3> points;
  std::vector<double> u;
  for (const Index node : border_nodes(own.mesh, run.input.box)) {
    points.push_back(own.mesh.points[node]);
    u.push_back(own.nodes[node].u);
  }
  ArchiveWriter archive;
  archive.add(points);
  archive.add(u);
  run.slabs.scratch.write(shared_nodes_file(k, s), archive);
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

/// A piece may have so many cells at least.
constexpr std::int64_t kFewestInPiece = 1000;

Heights heights_of(const TetMesh& mesh) {
  Heights heights{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
  for (const Cell& cell : mesh.cells) {
    const double height = height_of(mesh, cell);
    heights = {std::min(heights.low, height), std::max(heights.high, height)};
  }
  return heights;
}

/// The cells of mesh k that were minimised on between two heights, with their fields, and the
/// metrics of mesh k + 1 at their nodes.
/// @param own   whose cells are not those of another slab.
/// @param work  where the bytes of others are counted.
Piece solved_between(const MeshRun& run, int k, double low, double high, Index own,
                     SlabWork& work) {
  std::vector<Piece> pieces;
  for (Index t = 0; t < run.count(); ++t) {
    const Heights heights = mesh_record(run, k, t).heights;
    if (heights.high < low || heights.low >= high) continue;
    const Piece piece =
        read_piece(run.slabs.scratch, file_of("solved", k, t), t == own ? nullptr : &work);
    pieces.push_back(select(piece, [&](const Cell& cell) {
      const double height = height_of(piece.mesh, cell);
      return height >= low && height < high;
    }));
  }
  Piece piece = join(pieces);
  const Parameters& p = run.input.parameters;
  const double factor = run.mesh(k + 1).factor;
  std::vector<Sym3> metric = values_of(piece, &NodeValues::metric);
  for (Sym3& m : metric) m = (1 / (factor * factor)) * m;
  const std::vector<double> weights(metric.size(), 1);
  control_sizes(metric, weights, {p.h_min, p.h_max, 0});
  for (std::size_t n = 0; n < metric.size(); ++n) piece.nodes[n].metric = metric[n];
  return piece;
}

double volume_of(const TetMesh& mesh) {
  double volume = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    volume += cell_volume(mesh, static_cast<Index>(c));
  }
  return volume;
}

/// Writes the record of a pass, as far as it is the slab's own, to be added up.
/// @param own  the part of the local mesh that is the slab's.
void write_record(const MeshRun& run, int k, Index s, const LocalMesh& local, const Piece& own,
                  Iteration record) {
  const std::vector<double> u = values_of(own, &NodeValues::u);
  const std::vector<double> v = values_of(own, &NodeValues::v);
  const std::vector<double> f = values_of(own, &NodeValues::f);
  record.tets = std::ssize(own.mesh.cells);
  const std::vector<char> counted_below = shared_with(local, Owner::kBelow);
  record.nodes =
      std::ssize(own.mesh.points) - std::count(counted_below.begin(), counted_below.end(), 1);
  record.energy = energy(MeshSpace(own.mesh), run.input.parameters.functional, {u, v, f});
  MeshRecord whole{record, heights_of(own.mesh), volume_of(own.mesh)};
  for (const Vec3& p : own.mesh.points) whole.top = std::max(whole.top, p.z);
  ArchiveWriter archive;
  archive.add_one(whole);
  run.slabs.scratch.write(file_of("record", k, s), archive);
}

}  // namespace

std::string file_of(const char* what, int k, Index s) {
  return std::string(what) + "." + std::to_string(k) + "." + std::to_string(s);
}
MeshRecord mesh_record(const MeshRun& run, int k, Index s) {
  return run.slabs.scratch.read(file_of("record", k, s)).next_one<MeshRecord>();
}

const Stage& silent_stage() {
  static const Progress silent;
  static const Stage stage(silent, "");
  return stage;
}

Piece adapted(const MeshRun& run, const TetMesh& start, const Background& background,
              double complexity, double thickness) {
  // Only a guard: a border that stays needs cells whatever the metric asks for, and a bound that
  // cannot be kept would make all cells coarser, also those at the surface.
  constexpr double kMost = 2 * kCellsPerComplexity;
  // Of slabs: cells that reach from border to border are never adapted with all their points free.
  constexpr double kHighest = 0.5;
  RemeshOptions options;
  options.max_cells = std::llround(kMost * complexity) + std::ssize(start.cells) + kFewestInPiece;
  options.draft = run.input.parameters.drafts;
  const LowBackground low(background, run.input.parameters.h_max,
                          std::max(run.input.parameters.h_min, kHighest * thickness));
  Piece piece{remesh_piece(start, run.input.box, low, options), {}};
  piece.nodes = low.values(piece.mesh.points);
  return piece;
}

void hand_on(const MeshRun& run, int k, Index s, const Piece& mesh, SlabWork& work) {
  const SlabPlan& plan = run.plan(k);
  // Writes the cells that belong to a border, and returns the rest. Of a cell that belongs to both
  // the lower one gets it.
  const auto cut_off = [&](const char* what, const Piece& piece, const auto& belongs) {
    const auto side_of = [&](const Cell& cell) -> std::optional<Side> {
      for (const Side side : {Side::kLow, Side::kHigh}) {
        if (has_neighbour(plan, s, side) && belongs(cell, side)) return side;
      }
      return std::nullopt;
    };
    const auto part = [&](std::optional<Side> wanted) {
      return select(piece, [&](const Cell& cell) { return side_of(cell) == wanted; });
    };
    for (const Side side : {Side::kLow, Side::kHigh}) {
      if (!has_neighbour(plan, s, side)) continue;
      write_piece(run.slabs.scratch, side_file(what, k, s, side), part(side));
    }
    return part(std::nullopt);
  };
  const std::vector<std::optional<Side>> borders = sides_of_border(run, k, s, mesh.mesh);
  const Piece inner = cut_off("border", mesh, [&](const Cell& cell, Side side) {
    return std::any_of(cell.begin(), cell.end(), [&](Index n) { return borders[n] == side; });
  });
  const Piece core = cut_off("rim", inner, [&](const Cell& cell, Side side) {
    return is_near(inner.mesh, cell, border_of(plan, s, side), plan.overlap);
  });
  write_piece(run.slabs.scratch, file_of("core", k, s), core);
  work.cells += std::ssize(mesh.mesh.cells);
}

SlabWork seam(const MeshRun& run, int k, Index s) {
  const Scratch& scratch = run.slabs.scratch;
  const SlabPlan& plan = run.plan(k);
  SlabWork work;
  const Piece below = read_piece(scratch, side_file("border", k, s, Side::kHigh));
  const Piece above = read_piece(scratch, side_file("border", k, s + 1, Side::kLow), &work);
  const std::array<const Piece*, 2> both{&below, &above};
  const TetMesh start = join(both).mesh;
  const Box box = bounding_box(start.points);
  // Cells of the mesh before may be as large as a slab.
  const double around = k == 1 ? 0 : plan.least_thickness();
  const double low = box.lo.z - around, high = box.hi.z + around;
  std::unique_ptr<Background> background;
  if (k == 1) {
    background = grid_background(run, low, high, s, work);
  } else {
    background = std::make_unique<MeshBackground>(solved_between(run, k - 1, low, high, s, work));
  }
  const double needed = complexity(start, sample(*background, start.points));
  const double thickness = std::min(plan.thickness(s), plan.thickness(s + 1));
  const Piece piece = adapted(run, start, *background, needed, thickness);
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
  const Piece own = own_part(local);
  write_record(run, k, s, local, own, record);
  const Parameters& p = run.input.parameters;
  ArchiveWriter told;
  add_profile(told, profile_of(run.slabs.plan, own, {p.h_min, p.h_max, 0}));
  write_piece(run.slabs.scratch, file_of("solved", k, s), own);
  run.slabs.scratch.write(file_of("profile", k, s), told);
  return work;
}

SlabWork adapt_slab(const MeshRun& run, int k, Index s) {
  const SlabPlan& plan = run.plan(k);
  const double low = plan.height(s), high = plan.height(s + 1);
  SlabWork work;
  Piece around =
      solved_between(run, k - 1, low - 2 * plan.overlap, high + 2 * plan.overlap, s, work);
  const Piece own = select(around, [&](const Cell& cell) {
    const double height = height_of(around.mesh, cell);
    return (s == 0 || height >= low) && (s + 1 == plan.count() || height < high);
  });
  const MeshBackground background(std::move(around));
  const double needed = complexity(own.mesh, values_of(own, &NodeValues::metric));
  hand_on(run, k, s, adapted(run, own.mesh, background, needed, plan.thickness(s)), work);
  return work;
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
  write_record(run, k, s, local, own, record);
  write_piece(run.slabs.scratch, file_of("final", k, s), own);
  ArchiveWriter fit;
  fit.add_one(measure_fit(own.mesh, values_of(own, &NodeValues::metric)));
  run.slabs.scratch.write(file_of("fit", k, s), fit);
  write_shared_nodes(run, k, s, own);
  return work;
}

void require_full(const MeshRun& run, int k) {
  double volume = 0;
  for (Index s = 0; s < run.count(); ++s) volume += mesh_record(run, k, s).volume;
  constexpr double kRoundOff = 1e-9;
  const double share = volume / run.input.box.volume();
  if (std::abs(share - 1) < kRoundOff) return;
  throw NumericalError("slabs: expected a mesh that fills its box, found one of " +
                       std::to_string(share) + " of its volume");
}

std::string shared_nodes_file(int k, Index s) { return file_of("shared", k, s); }

double top_of_mesh(const MeshRun& run, int k, Index s) { return mesh_record(run, k, s).top; }

Piece read_final(const MeshRun& run, int k, Index s, SlabWork* work) {
  return read_piece(run.slabs.scratch, file_of("final", k, s), work);
}

std::vector<Iteration> records_of(const MeshRun& run, int k) {
  std::vector<Iteration> passes, records;
  for (const GridSlab& slab : run.grid) records.push_back(slab.record);
  passes.push_back(sum_of_records(records));
  for (int mesh = 1; mesh <= k; ++mesh) {
    for (Index s = 0; s < run.count(); ++s) {
      records[static_cast<std::size_t>(s)] = mesh_record(run, mesh, s).iteration;
    }
    passes.push_back(sum_of_records(records));
  }
  return passes;
}

MeshFit fit_of(const MeshRun& run, int k) {
  MeshFit whole;
  double cells = 0;
  for (Index s = 0; s < run.count(); ++s) {
    const MeshFit fit = run.slabs.scratch.read(file_of("fit", k, s)).next_one<MeshFit>();
    const auto own = static_cast<double>(mesh_record(run, k, s).iteration.tets);
    const auto edges = static_cast<double>(whole.edges), more = static_cast<double>(fit.edges);
    whole.unit_edge_fraction =
        (edges * whole.unit_edge_fraction + more * fit.unit_edge_fraction) / (edges + more);
    whole.quality_mean = (cells * whole.quality_mean + own * fit.quality_mean) / (cells + own);
    whole.length_min = s == 0 ? fit.length_min : std::min(whole.length_min, fit.length_min);
    whole.quality_min = s == 0 ? fit.quality_min : std::min(whole.quality_min, fit.quality_min);
    whole.length_max = std::max(whole.length_max, fit.length_max);
    whole.edges += fit.edges;
    cells += own;
  }
  return whole;
}

Piece collect(const MeshRun& run, int k) {
  std::vector<Piece> pieces;
  pieces.reserve(static_cast<std::size_t>(run.count()));
  for (Index s = 0; s < run.count(); ++s) pieces.push_back(read_final(run, k, s));
  return join(pieces);
}

}  // namespace mesamis::detail::slabs
