// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mes_amis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "mesamis/adapt/estimator.h"
#include "mesamis/adapt/grid_estimator.h"
#include "mesamis/adapt/metric_from_estimate.h"
#include "mesamis/adapt/size_control.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/fem/grid_space.h"
#include "mesamis/fem/mesh_space.h"
#include "mesamis/fem/transfer.h"
#include "mesamis/image/edge_sides.h"
#include "mesamis/image/scan_quality.h"
#include "mesamis/mesh/gradation.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/prepare.h"
#include "mesamis/printable.h"
#include "mesamis/remesh/remesh.h"
#include "mesamis/surface/beneath.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/measure.h"

namespace mesamis {
namespace {

/// Cells a remesher makes per unit of complexity, before it has been measured on this run.
constexpr double kCellsPerComplexity = 9.3;
/// Sweeps over the grid's log-metric before the first mesh is refined towards it.
constexpr int kSmoothingSweeps = 3;

/// All meshes but the last are there to find the next one: their fields need not be exact.
constexpr double kDraftTolerance = 1e-3;
constexpr int kDraftAlternations = 4;
/// Cells of the meshes against max_tets, one after the other; with fewer adaptations than
/// kToGrow the first are left out.
constexpr std::array kShares{0.25, 0.35, 0.6, 1.0};
constexpr int kToGrow = 6;

/// Nodal fields carried from mesh to mesh.
struct Fields {
  std::vector<double> f, u, v;
};

/// The first grid: every stride-th voxel, spread so that it fills the whole box.
KuhnGrid first_grid(const Volume& volume, const std::array<Index, 3>& stride, double unit) {
  KuhnGrid grid;
  grid.size = first_grid_size(volume.size, stride);
  const Vec3 extent = volume.box().extent();
  for (int a = 0; a < 3; ++a) {
    grid.spacing[a] = extent[a] / (grid.size[a] - 1) / unit;
  }
  return grid;
}

void measure_aspects(const TetMesh& mesh, Iteration& iteration) {
  struct Aspects {
    std::array<double, 3> max{}, sum{};
  };
  const std::size_t count = mesh.cells.size();
  std::vector<Aspects> blocks((count + kBlock - 1) / kBlock);
  parallel_blocks(count, kBlock, [&](std::size_t begin, std::size_t end) {
    Aspects& block = blocks[begin / kBlock];
    for (std::size_t c = begin; c < end; ++c) {
      const auto s = aspect_ratios(cell_shape(cell_corners(mesh, mesh.cells[c])));
      for (std::size_t i = 0; i < 3; ++i) {
        block.max[i] = std::max(block.max[i], s[i]);
        block.sum[i] += s[i];
      }
    }
  });
  iteration.aspect_max = iteration.aspect_mean = {};
  for (const Aspects& block : blocks) {
    for (std::size_t i = 0; i < 3; ++i) {
      iteration.aspect_max[i] = std::max(iteration.aspect_max[i], block.max[i]);
      iteration.aspect_mean[i] += block.sum[i] / static_cast<double>(count);
    }
  }
}

/// About as many points as triangles, evenly by area: small triangles crowd where the surface is
/// bent, and such places are not to decide for the others.
std::vector<SurfacePoint> points_by_area(const TriMesh& surface, double unit_mm) {
  const std::size_t count = surface.triangles.size();
  double total = 0;
  for (std::size_t n = 0; n < count; ++n) total += triangle_area(surface, n);
  const double share = total / static_cast<double>(count);
  std::vector<SurfacePoint> points;
  double gone = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const auto& [a, b, c] = surface.triangles[n];
    for (gone += triangle_area(surface, n); gone >= share; gone -= share) {
      const Vec3 normal = area_vector(surface, n);
      points.push_back({(unit_mm / 3) * (surface.points[a] + surface.points[b] + surface.points[c]),
                        (1 / norm(normal)) * normal});
    }
  }
  return points;
}

/// One run of Algorithm 2; the steps share the volume, the settings and the report.
class Run {
 public:
  Run(const Volume& volume, const Settings& settings, const Progress& progress)
      : volume_(volume), progress_(progress) {
    result_.settings = settings;
  }

  Result execute() {
    prepare();
    start_on_grid();
    for (int k = 2; k <= settings().adaptations && !settled_; ++k) {
      announce(adaptation_name(k));
      minimise(draft_);
      adapt();
    }
    announce("final minimisation");
    minimise(amis_);
    result_.fit = measure_fit(mesh_, asked_);
    extract();
    deliver();
    finish_surface();
    return std::move(result_);
  }

 private:
  Settings& settings() { return result_.settings; }
  Iteration& iteration() { return result_.iterations.back(); }

  /// Tells which stage begins.
  void announce(std::string stage) {
    stage_ = std::move(stage);
    advance(0);
  }
  std::string adaptation_name(int k) {
    return "adaptation " + std::to_string(k) + " of " + std::to_string(settings().adaptations);
  }

  /// Tells how far the stage has come.
  void advance(double share) const {
    if (progress_ && !progress_(stage_, share)) throw Cancelled();
  }

  /// Fills in the defaults that depend on the volume, and maps it to grey values.
  void prepare() {
    Stopwatch watch;
    announce("preparation");
    Prepared prepared = prepare_image(volume_, settings());
    settings() = prepared.settings;
    result_.unit_mm = prepared.unit_mm;
    result_.grey = prepared.map;
    result_.threshold_used = prepared.threshold_used;
    result_.level_native = prepared.level_native;
    result_.restored = {prepared.noise_left, prepared.impulses};
    grey_ = std::move(prepared.grey);
    amis_.parameters = {settings().epsilon, *settings().eta, settings().beta, *settings().gamma};
    amis_.max_iterations = settings().amis_iterations;
    amis_.v_tolerance = settings().tol_v;
    amis_.solver.tolerance = settings().solver_tolerance;
    draft_ = amis_;
    draft_.max_iterations = std::min(amis_.max_iterations, kDraftAlternations);
    draft_.solver.tolerance = std::max(amis_.solver.tolerance, kDraftTolerance);
    result_.seconds.prepare = watch.lap();
  }

  /// The first pass, on the voxel grid; the mesh it leads to is refined from a coarse box.
  void start_on_grid() {
    announce(adaptation_name(1) + ", on the voxel grid");
    result_.iterations.emplace_back();
    Stopwatch watch;
    const KuhnGrid grid = first_grid(volume_, settings().stride, result_.unit_mm);
    box_ = {{0, 0, 0}, (1 / result_.unit_mm) * volume_.box().extent()};
    const GridSpace space(grid);
    iteration().tets = grid.cell_count();
    iteration().nodes = static_cast<std::int64_t>(grid.node_count());
    Fields fields;
    fields.f = project_image(grey_, grid);
    iteration().seconds.project = watch.lap();
    run_amis_on(space, draft_, fields);
    advance(0.2);
    iteration().seconds.amis = watch.lap();
    GridEstimate estimated = estimate_on_grid(grid, amis_.parameters, fields.u, fields.v, fields.f,
                                              metric_options(grid.cell_count()));
    iteration().estimator = estimated.sums.zeta();
    iteration().predicted_tets = estimated.predicted_cells;
    const double factor =
        control_sizes_to_log(estimated.node_metrics, space.lumped_mass(), size_control());
    smooth_log_metrics(grid, estimated.node_metrics, kSmoothingSweeps);
    bounded_ = factor > 1;
    if (bounded_) {
      set_complexity(estimated.node_metrics, space.lumped_mass(), size_control().complexity);
    }
    iteration().seconds.estimate = watch.lap();
    const GridMetricField field(box_, grid.size, std::move(estimated.node_metrics));
    replace_mesh(coarse_box_mesh(box_), field);
    iteration().seconds.remesh = watch.lap();
    carry(interpolate_fields(grid, std::vector<std::span<const double>>{fields.u, fields.v},
                             mesh_.points));
    iteration().seconds.transfer = watch.lap();
    // One brick's cells are those of all the others.
    measure_aspects(box_mesh({{0, 0, 0}, grid.spacing}, {1, 1, 1}), iteration());
  }

  void run_amis_on(const P1Space& space, const AmisOptions& options, Fields& fields) {
    if (fields.v.empty()) fields.v.assign(space.node_count(), 1);
    AmisFields solved =
        run_amis(space, fields.f, std::move(fields.v), fields.u, options, &iteration().amis);
    fields.u = std::move(solved.u);
    fields.v = std::move(solved.v);
    iteration().energy = energy(space, amis_.parameters, fields.u, fields.v, fields.f);
  }

  /// Projects the image onto the present mesh and runs Algorithm 1 there.
  void minimise(const AmisOptions& options) {
    result_.iterations.emplace_back();
    Stopwatch watch;
    const MeshSpace space(mesh_);
    iteration().tets = static_cast<std::int64_t>(mesh_.cells.size());
    iteration().nodes = static_cast<std::int64_t>(mesh_.points.size());
    SolveReport projection;
    fields_.f = project_image(grey_, space, result_.unit_mm, options.solver, &projection);
    advance(0.1);
    iteration().seconds.project = watch.lap();
    run_amis_on(space, options, fields_);
    iteration().amis.solver_converged &= projection.converged;
    advance(0.3);
    iteration().seconds.amis = watch.lap();
    measure_aspects(mesh_, iteration());
    const double before = result_.iterations.rbegin()[1].energy.total();
    iteration().energy_change = std::abs(iteration().energy.total() - before) / before;
    lumped_mass_ = space.lumped_mass();
  }

  void adapt() {
    Stopwatch watch;
    set_metric(estimate_metric());
    iteration().seconds.estimate = watch.lap();
    const TetMesh old = std::move(mesh_);
    const MeshMetricField field(old, metric_);
    replace_mesh(old, field);
    iteration().seconds.remesh = watch.lap();
    carry(interpolate_fields(old, std::vector<std::span<const double>>{fields_.u, fields_.v},
                             mesh_.points));
    iteration().seconds.transfer = watch.lap();
    check_settled(static_cast<double>(old.cells.size()));
  }

  void check_settled(double cells_before) {
    iteration().mesh_change =
        std::abs(static_cast<double>(mesh_.cells.size()) - cells_before) / cells_before;
    // Energies on the grid and on adapted meshes are not compared: the first Ei means nothing.
    const bool energy_known = result_.iterations.size() > 2;
    const bool mesh_stagnates = iteration().mesh_change <= settings().tol_mesh;
    // A count that max_tets holds wavers by what the remesher's steering leaves.
    constexpr double kSteeringSlack = 0.06;
    const bool mesh_settled =
        mesh_stagnates || (bounded_ && iteration().mesh_change <= kSteeringSlack);
    const bool energy_settled = energy_known && iteration().energy_change <= settings().tol_energy;
    const bool settled = settings().stop_at_first ? mesh_stagnates || energy_settled
                                                  : mesh_settled && energy_settled;
    // While the count is still to grow nothing has.
    settled_ = settled && most_cells() == *settings().max_tets;
  }

  std::vector<Sym3> estimate_metric() {
    const Estimate estimated = estimate(mesh_, amis_.parameters, fields_.u, fields_.v, fields_.f);
    iteration().estimator = estimated.sums.zeta();
    std::vector<Sym3> cells(mesh_.cells.size());
    const auto options = metric_options(static_cast<std::int64_t>(cells.size()));
    parallel_for(cells.size(),
                 [&](std::size_t c) { cells[c] = cell_metric(estimated.gamma[c], options); });
    iteration().predicted_tets = predicted_cells(mesh_, cells);
    return node_metrics(mesh_, cells);
  }

  void set_metric(std::vector<Sym3> metric) {
    metric_ = std::move(metric);
    bounded_ = control_sizes(metric_, lumped_mass_, size_control()) > 1;
    if (settings().gradation == 0) return;
    limit_gradation(mesh_, metric_, settings().gradation);
    bounded_ |= control_sizes(metric_, lumped_mass_, size_control()) > 1;
  }

  CellMetricOptions metric_options(std::int64_t cells) {
    return {cells, settings().tau, settings().max_stretch};
  }

  /// Of the mesh that the present pass leads to: max_tets in the end, less at first, when the mesh
  /// is still to find out where the edges are and which way they run.
  std::int64_t most_cells() {
    const auto left_out = static_cast<std::size_t>(std::max(0, kToGrow - settings().adaptations));
    const std::size_t place = result_.iterations.size() - 1 + left_out;
    const auto most = static_cast<double>(*settings().max_tets);
    const double share = kShares[std::min(place, kShares.size() - 1)];
    return std::min(*settings().max_tets,
                    std::max<std::int64_t>(kFewestTets, std::llround(share * most)));
  }

  SizeControl size_control() {
    return {settings().h_min, *settings().h_max,
            static_cast<double>(most_cells()) / cells_per_complexity_};
  }

  void replace_mesh(const TetMesh& start, const MetricField& field) {
    constexpr double kShareBefore = 0.4;  // of a stage's time, what comes before remeshing
    RemeshOptions options;
    options.max_cells = most_cells();
    options.draft = options.max_cells < *settings().max_tets;
    options.progress = [this](std::string_view, double share) {
      advance(kShareBefore + (1 - kShareBefore) * share);
      return true;
    };
    RemeshReport report;
    mesh_ = remesh(start, field, options, &report);
    asked_ = sample(ScaledMetricField(field, report.size_factor), mesh_.points);
    if (!bounded_) return;
    // What one unit of the complexity asked for has cost steers the next pass.
    const double complexity = size_control().complexity / std::pow(report.size_factor, 3);
    cells_per_complexity_ =
        std::clamp(static_cast<double>(mesh_.cells.size()) / complexity, 4.0, 20.0);
  }

  void carry(std::vector<std::vector<double>> fields) {
    fields_.u = std::move(fields[0]);
    fields_.v = std::move(fields[1]);
  }

  double to_grey_level(double native) const { return result_.grey.to_grey(native); }

  void extract() {
    Stopwatch watch;
    announce("surface");
    if (settings().surface == SurfaceKind::kBand) {
      result_.surface = extract_band(mesh_, fields_.v, settings().band_threshold);
    } else {
      if (!settings().level) refine_level();
      settings().level = result_.level_native;
      result_.surface = extract_solid(mesh_, fields_.u, to_grey_level(result_.level_native));
    }
    result_.seconds.surface = watch.lap();
  }

  /// Measured along the surface itself, in the image as it came: restoring it overshoots at edges.
  void refine_level() {
    // Caps at the box are no edges of the image.
    const TriMesh surface = extract_solid(mesh_, fields_.u, to_grey_level(result_.level_native),
                                          {.close_at_box = false});
    const auto points = points_by_area(surface, result_.unit_mm);
    const auto level = measure_level(volume_, points);
    if (!level) return;
    if (!result_.threshold_used || *level > result_.grey.threshold) {
      result_.level_native = *level;
    }
  }

  /// From length units in the grid's axes to mm in the world frame.
  void deliver() {
    const Vec3 extent = volume_.box().extent();
    auto to_world = [&](std::vector<Vec3>& points) {
      parallel_for(points.size(), [&](std::size_t n) {
        Vec3 p = result_.unit_mm * points[n];
        for (int a = 0; a < 3; ++a) {
          // Round-off must not move the box: what lay on it lies on the voxels' own box.
          if (points[n][a] == box_.hi[a] || p[a] > extent[a]) p[a] = extent[a];
        }
        points[n] = volume_.to_world(p);
      });
    };
    to_world(mesh_.points);
    to_world(result_.surface.points);
    if (determinant(volume_.direction) < 0) mirror();
    for (const Iteration& pass : result_.iterations) {
      solved_ &= pass.amis.solver_converged;
    }
    result_.converged = settled_ && solved_;
    result_.metric = world_metric();
    result_.mesh = std::move(mesh_);
    result_.u = std::move(fields_.u);
    result_.v = std::move(fields_.v);
    result_.f = std::move(fields_.f);
  }

  /// The paper's band is delivered as it is.
  void finish_surface() {
    Stopwatch watch;
    const bool solid = settings().surface == SurfaceKind::kSolid;
    TriMesh& surface = result_.surface;
    result_.printable.triangles_extracted = static_cast<std::int64_t>(surface.triangles.size());
    if (solid) surface = make_printable(surface, settings(), progress_, result_.printable);
    result_.seconds.printable = watch.lap();
  }

  /// A left-handed grid turns every orientation round.
  void mirror() {
    for (Cell& cell : mesh_.cells) std::swap(cell[2], cell[3]);
    for (Triangle& triangle : result_.surface.triangles) std::swap(triangle[1], triangle[2]);
  }

  /// D M D' / unit^2 with D the direction cosines.
  std::vector<Sym3> world_metric() const {
    const auto& r = volume_.direction.rows;
    const double scale = 1 / (result_.unit_mm * result_.unit_mm);
    std::vector<Sym3> world(asked_.size());
    parallel_for(world.size(), [&](std::size_t n) {
      const std::array<Vec3, 3> mr{asked_[n] * r[0], asked_[n] * r[1], asked_[n] * r[2]};
      world[n] = scale * Sym3{dot(r[0], mr[0]), dot(r[0], mr[1]), dot(r[0], mr[2]),
                              dot(r[1], mr[1]), dot(r[1], mr[2]), dot(r[2], mr[2])};
    });
    return world;
  }

  const Volume& volume_;
  const Progress& progress_;
  Result result_;
  Volume grey_;               // the image, restored
  AmisOptions amis_, draft_;  // of the mesh delivered, of those before
  Box box_;
  TetMesh mesh_;
  Fields fields_;
  std::vector<double> lumped_mass_;   // of the mesh last minimised on
  std::vector<Sym3> metric_, asked_;  // of the mesh estimated, and of the mesh it led to
  double cells_per_complexity_ = kCellsPerComplexity;
  bool bounded_ = false;  // max_tets acted on the last metric
  bool settled_ = false, solved_ = true;
  std::string stage_;
};

}  // namespace

Result mes_amis(const Volume& volume, const Settings& settings, const Progress& progress) {
  Stopwatch watch;
  require_valid(settings);
  require_usable(volume);
  const CropRange& range = settings.crop;
  Result result = range == CropRange{} ? Run(volume, settings, progress).execute()
                                       : Run(crop(volume, range), settings, progress).execute();
  result.seconds.total = watch.lap();
  return result;
}

std::vector<double> surface_grey(const Result& result, double voxel) {
  constexpr double kVoxels = 2;
  constexpr int kSamples = 4;
  const bool solid = result.settings.surface == SurfaceKind::kSolid;
  return greatest_beneath(result.mesh, result.u, result.surface, solid ? kVoxels * voxel : 0,
                          kSamples);
}

}  // namespace mesamis
