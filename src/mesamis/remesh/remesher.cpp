// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/remesher.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/remesh/balance.h"
#include "mesamis/remesh/collapse.h"
#include "mesamis/remesh/explore.h"
#include "mesamis/remesh/mesh_parts.h"
#include "mesamis/remesh/repair.h"
#include "mesamis/remesh/shape_repair.h"
#include "mesamis/remesh/smooth.h"
#include "mesamis/remesh/split.h"
#include "mesamis/remesh/swap.h"

namespace mesamis::detail::remesh {
namespace {

/// The least that kCellsPerComplexity was found to be: a metric is made coarser beforehand only
/// where even so few cells are too many.
constexpr double kFewestCellsPerComplexity = 9;

/// Shares of the vertices that a round makes or removes.
constexpr double kBusy = 0.3, kMany = 0.2, kSome = 0.05, kFew = 0.02, kHardlyAny = 0.004;
/// A round that makes and removes more than this share of the vertices of the round before undoes
/// much of what that did: splits and collapses answer each other.
constexpr double kSlow = 0.72, kStuck = 0.8;
/// At a border that stays, whose edges may be far too long, splits and collapses never end. Cells
/// that each made a little worse would get as flat as numbers can tell.
constexpr double kFloorAtBorder = 1e-5;
/// So many rounds accept new edges a little outside the goal.
constexpr int kWideRoundsMin = 9, kWideRoundsMax = 14;

struct Rules {
  SplitRule split;
  CollapseRule collapse;
  SwapRule swap;
  SmoothRule smooth;
};

/// @param floor  of the quality, see SplitRule.
Rules make_rules(Bands bands, double floor) {
  Rules rules;
  rules.split.quality3_floor = rules.collapse.quality3_floor = floor;
  if (bands == Bands::kBalanced) {
    rules.split.balance = 0.95;
    rules.collapse.balance = 1.05;
  } else if (bands == Bands::kGoal) {
    rules.split.new_length_min = std::sqrt(0.5);
    rules.collapse.new_length_max = std::sqrt(2.0);
  }
  return rules;
}

Counters adapt_once(Workbench& bench, const Rules& rules) {
  Counters done;
  done.splits = split_long_edges(bench, rules.split);
  done.collapses = collapse_short_edges(bench, rules.collapse);
  done.swaps = swap_bad_cells(bench, rules.swap);
  done.swaps += swap_bad_cells(bench, rules.swap);
  done.moves = smooth_bad_cells(bench, rules.smooth);
  done.swaps += swap_bad_cells(bench, rules.swap);
  return done;
}

Counters polish_once(Workbench& bench, bool is_last) {
  constexpr SwapRule kSwap{.quality3_max = 0.512, .gain = 0.03};
  constexpr SmoothRule kSmooth{.quality3_max = 1, .most_rest = 0, .small_gain = 0};
  Counters done;
  done.swaps = swap_bad_cells(bench, kSwap);
  done.moves = smooth_bad_cells(bench, kSmooth);
  done.swaps += swap_bad_cells(bench, kSwap);
  if (is_last) done += repair_worst_cells(bench, {});
  return done;
}

}  // namespace

Remesher::Remesher(WorkingMesh mesh, const MetricSampler& sampler, const RemeshOptions& options)
    : options_(options), sampler_(sampler), mesh_(std::move(mesh)) {
  compact(mesh_);
  compact_count_ = mesh_.cell_count();
  choose_size_factor();
  measure_all(mesh_, sampler_);
}

void Remesher::adapt() {
  double last_change = 1;
  for (int round = 0; round < options_.max_rounds && !report_.converged; ++round) {
    tell_progress(0.8 * (1 - std::pow(0.85, round)));
    const auto cells_before = static_cast<double>(mesh_.cell_count());
    Counters done = explore();
    done += run_round(round);
    growth_ = static_cast<double>(mesh_.cell_count()) / cells_before;
    count(done);
    const double change = share_of_vertices(done);
    const bool resized = control_count(change);
    report_.converged = !resized && is_done(change, last_change);
    // A mesh that must change its count gets freedom to do so, unless it has settled.
    if (resized) bands_ = Bands::kWide;
    bands_ = next_bands(round, change, last_change);
    last_change = change;
  }
}

void Remesher::polish() {
  set_pending(mesh_, kToSwap | kToSmooth | kToRepair);
  const int rounds = options_.draft ? std::min(1, options_.polish_rounds) : options_.polish_rounds;
  for (int round = 0; round < rounds; ++round) {
    tell_progress(0.8 + 0.2 * round / rounds);
    const bool is_last = round + 1 == rounds;
    count(on_parts(options_.max_rounds + round,
                   [is_last](Workbench& bench) { return polish_once(bench, is_last); }));
  }
  // What the parts could not repair: cells at their borders.
  Workbench bench(mesh_, sampler_);
  count(repair_worst_cells(bench, {}));
}

void Remesher::repair() {
  constexpr int kRounds = 2;
  set_pending(mesh_, kToRepair);
  for (int round = 0; round < kRounds; ++round) {
    count(on_parts(options_.max_rounds + options_.polish_rounds + round,
                   [](Workbench& bench) { return repair_shapes(bench, {}); }));
  }
  Workbench bench(mesh_, sampler_);  // what lies at the borders of the parts
  count(repair_shapes(bench, {}));
}

// Twice: vertices at the borders of the parts of the first round, and what their neighbours' moves
// changed.
void Remesher::balance() {
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    count(on_parts(options_.max_rounds + options_.polish_rounds + round,
                   [](Workbench& bench) { return balance_skin(bench, {}); }));
  }
}

WorkingMesh& Remesher::result() {
  compact(mesh_);
  return mesh_;
}

/// The share of vertices that came or went.
double Remesher::share_of_vertices(const Counters& done) const {
  return static_cast<double>(done.splits + done.collapses) /
         static_cast<double>(mesh_.vertex_count());
}

bool Remesher::is_done(double change, double last_change) const {
  if (options_.draft && change < kMany) return true;
  const bool circling = (change < kFew || mesh_.is_part) && change > 0.8 * last_change;
  return bands_ == Bands::kGoal && (change < kHardlyAny || circling);
}

/// Is the mesh so near its goal that new edges can be held to it? Or going round in circles?
bool Remesher::is_settled(int round, double change, double last_change) const {
  // A start that fits already needs no freedom to get there.
  if (round == 0) return change < kMany;
  const double stuck = bands_ == Bands::kWide ? 0.95 : kStuck;
  if (change < kMany && change > stuck * last_change) return true;
  if (bands_ == Bands::kWide && round + 1 < kWideRoundsMin) return change < kHardlyAny;
  return change < kSome || round + 1 >= kWideRoundsMax;
}

Bands Remesher::next_bands(int round, double change, double last_change) const {
  if (bands_ == Bands::kGoal || is_settled(round, change, last_change)) return Bands::kGoal;
  const bool slow = round > 0 && change < kBusy && change > kSlow * last_change;
  return slow ? Bands::kBalanced : bands_;
}

void Remesher::tell_progress(double fraction) const {
  if (options_.progress && !options_.progress("remesh", fraction)) throw Cancelled();
}

void Remesher::count(const Counters& done) {
  report_.splits += done.splits;
  report_.collapses += done.collapses;
  report_.swaps += done.swaps;
  report_.moves += done.moves;
}

/// No more cells than this at any time, by splits.
std::int64_t Remesher::most_cells() const {
  if (options_.max_cells <= 0) return kMostCells / 2;
  return std::min(kMostCells / 2, 2 * options_.max_cells + 1000);
}

/// Late rounds know all there is to find.
Counters Remesher::explore() {
  if (bands_ == Bands::kGoal || mesh_.shape != nullptr) return {};
  Workbench bench(mesh_, sampler_);
  SplitRule rule;
  rule.most_cells = most_cells();
  return {.splits = split_unseen_detail(bench, rule)};
}

Counters Remesher::run_round(int round) {
  ++report_.rounds;
  const double growth = static_cast<double>(most_cells()) / static_cast<double>(mesh_.cell_count());
  return on_parts(round, [&](Workbench& bench) {
    Rules rules = make_rules(bands_, mesh_.is_part ? kFloorAtBorder : 0);
    rules.split.most_cells =
        static_cast<std::int64_t>(growth * static_cast<double>(bench.mesh.cell_count()));
    return adapt_once(bench, rules);
  });
}

/// Parts are cut so that they have the size wanted when the work is done, as far as the last
/// round's growth tells.
Index Remesher::part_count() const {
  constexpr double kMostGrowth = 8;
  const double cells =
      static_cast<double>(mesh_.cell_count()) * std::clamp(growth_, 1.0, kMostGrowth);
  return static_cast<Index>(cells / std::max(Index{1000}, options_.part_cells));
}

/// Small meshes are worked on as a whole.
Counters Remesher::on_parts(int round, const std::function<Counters(Workbench&)>& work) {
  const Index parts = part_count();
  auto work_on_mesh = [&](WorkingMesh& mesh) {
    Workbench bench(mesh, sampler_);
    return work(bench);
  };
  if (parts >= 2) {
    // Each part is compacted after its work; before it only unused slots must go.
    if (!mesh_.free_cells.empty() || !mesh_.free_vertices.empty()) compact(mesh_);
    PartsReport done = work_on_parts(mesh_, {round, parts}, work_on_mesh);
    report_.part_seconds.push_back(std::move(done.seconds));
    return done.counters;
  }
  const Counters done = work_on_mesh(mesh_);
  keep_compact();
  return done;
}

void Remesher::keep_compact() {
  const double ratio =
      static_cast<double>(mesh_.cell_count()) / static_cast<double>(compact_count_);
  if (ratio < 1.15 && ratio > 0.85) return;
  compact(mesh_);
  compact_count_ = mesh_.cell_count();
}

void Remesher::choose_size_factor() {
  // The start of a body says how many there will be; of a piece's metric only a part is known.
  if (mesh_.shape != nullptr || mesh_.is_part) return;
  const double predicted = kFewestCellsPerComplexity * probe_complexity(sampler_, mesh_.box);
  if (options_.max_cells > 0) {
    const double ratio = predicted / static_cast<double>(options_.max_cells);
    set_size_factor(std::max(1.0, std::cbrt(ratio)));
  } else if (!(predicted < 0.5 * static_cast<double>(kMostCells))) {
    throw InputError("remesh: expected a metric of less than " + number_text(0.5 * kMostCells) +
                     " cells, or a limit of cells, found one of about " +
                     number_text(std::round(predicted)));
  }
}

void Remesher::set_size_factor(double factor) {
  report_.size_factor = factor;
  sampler_.set_size_factor(factor);
}

/// Steers the number of cells to max_cells, which acts as a factor on all sizes.
/// @return whether the factor had to change.
bool Remesher::control_count(double change) {
  if (options_.max_cells <= 0) return false;
  const double ratio =
      static_cast<double>(mesh_.cell_count()) / static_cast<double>(options_.max_cells);
  const double tolerance = bands_ == Bands::kGoal ? 0.06 : change < kMany ? 0.02 : 0.3;
  const bool above = ratio > 1 + tolerance;
  const bool below = ratio < 1 - tolerance && change < kMany && report_.size_factor > 1;
  if (!above && !below) return false;
  resize(std::max(1.0, report_.size_factor * std::cbrt(ratio)));
  return true;
}

void Remesher::resize(double factor) {
  const auto scale = static_cast<float>(report_.size_factor / factor);
  for (Vertex& vertex : mesh_.vertices) {
    MetricFactor& l = vertex.metric;
    l = {scale * l.xx, scale * l.yx, scale * l.zx, scale * l.yy, scale * l.zy, scale * l.zz};
    vertex.density *= scale * scale * scale;
  }
  set_size_factor(factor);
  set_pending(mesh_, kToSplit | kToCollapse | kToExplore);
}

}  // namespace mesamis::detail::remesh
