// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/passes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "mesamis/adapt/estimator.h"
#include "mesamis/adapt/grid_estimator.h"
#include "mesamis/adapt/metric_from_estimate.h"
#include "mesamis/adapt/size_control.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/fem/grid_amis.h"
#include "mesamis/fem/mesh_space.h"
#include "mesamis/fem/transfer.h"
#include "mesamis/mesh/gradation.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/method/surface_change.h"
#include "mesamis/remesh/remesh.h"
#include "mesamis/surface/extract.h"

namespace mesamis::detail::method {
namespace {

/// Sweeps over the grid's log-metric before the first mesh is refined towards it.
constexpr int kSmoothingSweeps = 3;

/// All meshes but the last are there to find the next one: their fields need not be exact.
constexpr double kDraftTolerance = 1e-3;
constexpr int kDraftAlternations = 4;
/// Cells of the meshes against max_tets, one after the other; with fewer adaptations the first are
/// left out. Where there are many, a mesh less is as accurate.
constexpr std::array kSharesOfFew{0.3, 0.6, 1.0};
constexpr std::array kSharesOfMany{0.6, 1.0};
constexpr std::int64_t kFew = 150'000;
/// The first mesh moves the grid's surface by more than the second moves that of the first: in the
/// mean of fifteen scans so many times.
constexpr double kFromGrid = 1.2;
/// Voxels: following the image makes up for meshes that are so far from it.
constexpr double kFollowed = 0.2;

/// The first grid: every stride-th voxel, spread so that it fills the whole box.
KuhnGrid first_grid(const RunInput& run) {
  KuhnGrid grid;
  grid.size = first_grid_size(run.grey.size, run.parameters.stride);
  const Vec3 extent = run.grey.box().extent();
  for (int a = 0; a < 3; ++a) {
    grid.spacing[a] = extent[a] / (grid.size[a] - 1) / run.parameters.unit_mm;
  }
  return grid;
}

void record_aspects(const TetMesh& mesh, Iteration& record) {
  const AspectSummary aspects = summarize_aspects(mesh);
  record.aspect_max = aspects.max;
  record.aspect_mean = aspects.mean;
}

/// What one adaptation asks of metric and remesher.
struct Sizes {
  std::int64_t cells;           // at most
  double cells_per_complexity;  // as last measured
  SizeControl control;          // bounds of the edge lengths, and the complexity of so many cells
};

Sizes sizes_of(const Pass& pass, double cells_per_complexity) {
  const std::int64_t cells = pass.run.cells_after(pass.number);
  const Parameters& p = pass.run.parameters;
  return {cells,
          cells_per_complexity,
          {p.h_min, p.h_max, static_cast<double>(cells) / cells_per_complexity}};
}

CellMetricOptions metric_options(const RunInput& run, std::int64_t cells) {
  return {cells, run.parameters.tau, run.parameters.max_stretch};
}

/// The logarithms of the metric that a run's fields ask for, and whether max_tets acted on it.
std::vector<PackedSym3> log_metrics(const Pass& pass, const KuhnGrid& grid,
                                    const GridFields& fields, const SizeControl& control) {
  const RunInput& run = pass.run;
  Iteration& record = pass.record;
  GridEstimate estimated = estimate_on_grid(grid, run.parameters.functional, fields,
                                            metric_options(run, grid.cell_count()));
  record.estimator = estimated.sums.zeta();
  record.predicted_tets = estimated.predicted_cells;
  record.bounded = control_sizes_to_log(grid, estimated.node_metrics, control) > 1;
  return std::move(estimated.node_metrics);
}

/// Refines the metric for the edges of the images beside.
void add_metrics_beside(const Pass& pass, const KuhnGrid& grid, const SizeControl& control,
                        std::vector<PackedSym3>& logs) {
  for (const RunInput* other : pass.run.beside) {
    Iteration unused;
    const Pass beside{*other, pass.number, pass.stage, unused};
    const GridPass found = minimise_on_grid(beside);
    const auto& m = found.minimum;
    const auto more = log_metrics(beside, grid, {m.u, m.v, found.image(*other)}, control);
    parallel_for(logs.size(), [&](std::size_t n) {
      logs[n] = pack(intersect(exp_sym(unpack(logs[n])), exp_sym(unpack(more[n]))));
    });
    const double factor = control_sizes_to_log(grid, logs, control);
    pass.record.bounded |= unused.bounded || factor > 1;
  }
}

/// The metric on a mesh, refined for the edges of the images beside.
std::vector<Sym3> metric_of_all(const Pass& pass, const TetMesh& mesh, const Minimum& minimum,
                                const SizeControl& control) {
  std::vector<Sym3> metric = mesh_metric(pass, mesh, minimum, control);
  for (const RunInput* other : pass.run.beside) {
    Iteration unused;
    const Pass beside{*other, pass.number, pass.stage, unused};
    const Minimum m = minimise(beside, mesh, {}, other->draft_options());
    const std::vector<Sym3> more = mesh_metric(beside, mesh, m, control);
    parallel_for(metric.size(), [&](std::size_t n) { metric[n] = intersect(metric[n], more[n]); });
    const double factor = control_sizes(metric, m.lumped_mass, control);
    pass.record.bounded |= unused.bounded || factor > 1;
  }
  return metric;
}

/// Remeshes towards the metric; the fields are still to be carried over. Where max_tets acted, the
/// cost of a unit of complexity is measured.
State remeshed(const Pass& pass, const TetMesh& start, const MetricField& field,
               const Sizes& sizes) {
  constexpr double kShareBefore = 0.4;  // of a stage's time, what comes before remeshing
  RemeshOptions options;
  options.max_cells = sizes.cells;
  options.draft = pass.run.parameters.drafts;
  options.progress = [&pass](std::string_view, double share) {
    pass.stage.advance(kShareBefore + (1 - kShareBefore) * share);
    return true;
  };
  RemeshReport report;
  State next;
  next.mesh = remesh::remesh(start, field, options, &report);
  next.metric = sample(ScaledMetricField(field, report.size_factor), next.mesh.points);
  next.cells_per_complexity = sizes.cells_per_complexity;
  if (pass.record.bounded) {
    const double complexity = sizes.control.complexity / std::pow(report.size_factor, 3);
    next.cells_per_complexity =
        std::clamp(static_cast<double>(next.mesh.cells.size()) / complexity, 4.0, 20.0);
  }
  return next;
}

/// One for each mesh that is made at least.
std::span<const double> shares_of(const Parameters& p) {
  if (p.drafts && p.max_tets > kFew) return kSharesOfMany;
  return kSharesOfFew;
}

bool has_settled_by_energy(const Parameters& p, const std::vector<Iteration>& passes) {
  const Iteration& last = passes.back();
  // Energies on the grid and on adapted meshes are not compared: the first Ei means nothing.
  const bool energy_settled = passes.size() > 2 && last.energy_change <= p.tol_energy;
  const bool mesh_stagnates = last.mesh_change <= p.tol_mesh;
  if (p.until == StopRule::kEither) return mesh_stagnates || energy_settled;
  // A count that max_tets holds wavers by what the remesher's steering leaves.
  constexpr double kSteeringSlack = 0.06;
  const bool mesh_settled = mesh_stagnates || (last.bounded && last.mesh_change <= kSteeringSlack);
  return mesh_settled && energy_settled;
}

ErrorOptions known_of(const MeasuredImage& measured, const Parameters& p) {
  const double scale = p.grey.grey_per_native();
  const auto [x, y, z] = measured.surface_noise;
  return {.noise = {scale * x, scale * y, scale * z},
          .contrast = scale * measured.contrast,
          .level = scale * measured.level_uncertainty,
          .blur = p.blur};
}

}  // namespace

RunInput::RunInput(const Prepared& prepared)
    : parameters(prepared.parameters),
      grey(prepared.grey),
      image(prepared.image),
      box{{0, 0, 0}, (1 / parameters.unit_mm) * grey.box().extent()},
      excess(prepared.excess),
      noise(prepared.measured.noise_left * parameters.grey.grey_per_native()),
      error(known_of(prepared.measured, parameters)) {}

AmisOptions RunInput::final_options() const {
  AmisOptions options;
  options.parameters = parameters.functional;
  options.max_iterations = parameters.amis_iterations;
  options.v_tolerance = parameters.tol_v;
  options.solver.tolerance = parameters.solver_tolerance;
  return options;
}

AmisOptions RunInput::draft_options() const {
  AmisOptions options = final_options();
  if (!parameters.drafts) return options;
  options.max_iterations = std::min(options.max_iterations, kDraftAlternations);
  options.solver.tolerance = std::max(options.solver.tolerance, kDraftTolerance);
  return options;
}

std::int64_t RunInput::cells_after(int k) const {
  if (!parameters.drafts) return parameters.max_tets;
  const std::span<const double> shares = shares_of(parameters);
  const auto meshes = static_cast<int>(shares.size());
  const int left_out = std::max(0, meshes - parameters.adaptations);
  const int place = std::min(k - 1 + left_out, meshes - 1);
  const double share = shares[static_cast<std::size_t>(place)];
  return std::min(parameters.max_tets,
                  std::max<std::int64_t>(
                      kFewestTets, std::llround(share * static_cast<double>(parameters.max_tets))));
}

void minimise_on(const P1Space& space, const AmisOptions& options, Minimum& m, Iteration& record) {
  AmisResult solved = run_amis(space, m.f, {std::move(m.v), m.u}, options);
  record.amis = solved.report;
  m.u = std::move(solved.u);
  m.v = std::move(solved.v);
  record.energy = energy(space, options.parameters, {m.u, m.v, m.f});
}

std::vector<Sym3> asked_metric(const Pass& pass, const TetMesh& mesh, const Minimum& m,
                               std::int64_t cell_count) {
  const RunInput& run = pass.run;
  const Estimate estimated = estimate(mesh, run.parameters.functional, {m.u, m.v, m.f});
  pass.record.estimator = estimated.sums.zeta();
  std::vector<Sym3> cells(mesh.cells.size());
  const auto options = metric_options(run, cell_count);
  parallel_for(cells.size(),
               [&](std::size_t c) { cells[c] = cell_metric(estimated.gamma[c], options); });
  pass.record.predicted_tets = predicted_cells(mesh, cells);
  return node_metrics(mesh, cells);
}

std::vector<Sym3> mesh_metric(const Pass& pass, const TetMesh& mesh, const Minimum& m,
                              const SizeControl& control) {
  const RunInput& run = pass.run;
  Iteration& record = pass.record;
  std::vector<Sym3> metric = asked_metric(pass, mesh, m, std::ssize(mesh.cells));
  record.bounded = control_sizes(metric, m.lumped_mass, control) > 1;
  if (run.parameters.gradation != 0) {
    limit_gradation(mesh, metric, run.parameters.gradation);
    record.bounded |= control_sizes(metric, m.lumped_mass, control) > 1;
  }
  return metric;
}

GridPass minimise_on_grid(const Pass& pass) {
  const auto& [run, number, stage, record] = pass;
  Stopwatch watch;
  GridPass found{first_grid(run), {}, {}};
  const KuhnGrid& grid = found.grid;
  record.tets = grid.cell_count();
  record.nodes = static_cast<std::int64_t>(grid.node_count());
  if (grid.size != run.grey.size) found.projected = project_image(run.grey, grid);
  record.seconds.project = watch.lap();
  found.minimum = run_amis_on_grid(grid, found.image(run), run.draft_options());
  record.amis = found.minimum.report;
  record.energy = found.minimum.energy;
  stage.advance(0.2);
  record.seconds.amis = watch.lap();
  // One brick's cells are those of all the others.
  record_aspects(box_mesh({{0, 0, 0}, grid.spacing}, {1, 1, 1}), record);
  return found;
}

std::vector<PackedSym3> grid_log_metric(const Pass& pass, const KuhnGrid& grid,
                                        const GridFields& fields, const SizeControl& control) {
  std::vector<PackedSym3> logs = log_metrics(pass, grid, fields, control);
  add_metrics_beside(pass, grid, control, logs);
  smooth_log_metrics(grid, logs, kSmoothingSweeps);
  if (pass.record.bounded) set_complexity(grid, logs, control.complexity);
  return logs;
}

State adapt_from_grid(const Pass& pass) {
  const auto& [run, number, stage, record] = pass;
  const GridPass found = minimise_on_grid(pass);
  const auto& [grid, projected, m] = found;
  Stopwatch watch;
  const Sizes sizes = sizes_of(pass, kCellsPerComplexity);
  const GridMetricField field(
      run.box, grid.size, grid_log_metric(pass, grid, {m.u, m.v, found.image(run)}, sizes.control));
  record.seconds.estimate = watch.lap();
  State next = remeshed(pass, coarse_box_mesh(run.box), field, sizes);
  record.seconds.remesh = watch.lap();
  auto fields =
      interpolate_fields(grid, std::vector<std::span<const float>>{m.u, m.v}, next.mesh.points);
  next.u = std::move(fields[0]);
  next.v = std::move(fields[1]);
  record.seconds.transfer = watch.lap();
  return next;
}

Minimum minimise(const Pass& pass, const TetMesh& mesh, Guess guess, const AmisOptions& options) {
  const auto& [run, number, stage, record] = pass;
  Stopwatch watch;
  const MeshSpace space(mesh);
  record.tets = std::ssize(mesh.cells);
  record.nodes = std::ssize(mesh.points);
  ProjectedImage projection =
      project_image(run.image, space, {run.parameters.unit_mm, options.solver});
  Minimum m;
  m.f = std::move(projection.values);
  m.u = std::move(guess.u);
  m.v = std::move(guess.v);
  stage.advance(0.1);
  record.seconds.project = watch.lap();
  minimise_on(space, options, m, record);
  m.lumped_mass = space.lumped_mass();
  record.amis.solver_converged &= projection.solve.converged;
  stage.advance(0.3);
  record.seconds.amis = watch.lap();
  record_aspects(mesh, record);
  return m;
}

State adapt(const Pass& pass, const State& state, const Minimum& minimum) {
  Iteration& record = pass.record;
  Stopwatch watch;
  const Sizes sizes = sizes_of(pass, state.cells_per_complexity);
  const MeshMetricField field(state.mesh, metric_of_all(pass, state.mesh, minimum, sizes.control));
  record.seconds.estimate = watch.lap();
  State next = remeshed(pass, state.mesh, field, sizes);
  record.seconds.remesh = watch.lap();
  auto fields = interpolate_fields(
      state.mesh, std::vector<std::span<const double>>{minimum.u, minimum.v}, next.mesh.points);
  next.u = std::move(fields[0]);
  next.v = std::move(fields[1]);
  record.seconds.transfer = watch.lap();
  const auto before = static_cast<double>(state.mesh.cells.size());
  record.mesh_change = std::abs(static_cast<double>(next.mesh.cells.size()) - before) / before;
  return next;
}

void bring_to_world(const RunInput& run, std::vector<Vec3>& points) {
  const Vec3 extent = run.grey.box().extent();
  parallel_for(points.size(), [&](std::size_t n) {
    Vec3 p = run.parameters.unit_mm * points[n];
    for (int a = 0; a < 3; ++a) {
      // Round-off must not move the box: what lay on it lies on the voxels' own box.
      if (points[n][a] == run.box.hi[a] || p[a] > extent[a]) p[a] = extent[a];
    }
    points[n] = run.grey.to_world(p);
  });
}

ErrorSummary expected_shape_error(const RunInput& run, const TriMesh& surface) {
  ErrorOptions of_shape = run.error;
  of_shape.level = 0;
  return summarize_error(surface, expected_error(surface, run.image, of_shape));
}

void record_surface(const Pass& pass, const TetMesh& mesh, std::span<const double> before,
                    std::span<const double> now) {
  const auto& [run, number, stage, record] = pass;
  const Parameters& p = run.parameters;
  if (p.surface != SurfaceKind::kSolid) return;
  const double level = p.grey.to_grey(p.level), voxel = run.grey.voxel_size();
  record.surface_change =
      p.unit_mm * level_set_change(mesh, before, now, {level, voxel / p.unit_mm});
  TriMesh surface = extract_solid(mesh, now, level);
  bring_to_world(run, surface.points);
  const double error = expected_shape_error(run, surface).mean;
  record.surface_tolerance = std::max(error, p.follow ? kFollowed * voxel : 0);
}

bool has_settled(const RunInput& run, const std::vector<Iteration>& passes) {
  const Parameters& p = run.parameters;
  if (run.cells_after(static_cast<int>(passes.size())) != p.max_tets) return false;
  const bool solid = p.surface == SurfaceKind::kSolid;
  if (p.until != StopRule::kSurface || !solid) return has_settled_by_energy(p, passes);
  const Iteration& last = passes.back();
  const auto needed = std::min(std::ssize(shares_of(p)), std::ptrdiff_t{p.adaptations});
  const double times = passes.size() == 2 ? kFromGrid : 1;
  return std::ssize(passes) >= needed && last.surface_change <= times * last.surface_tolerance;
}

}  // namespace mesamis::detail::method
