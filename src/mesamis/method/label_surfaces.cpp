// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/label_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/decimate/decimate_partition.h"
#include "mesamis/decimate/round_together.h"
#include "mesamis/labels/flow_memberships.h"
#include "mesamis/labels/label_block.h"
#include "mesamis/labels/label_confidence.h"
#include "mesamis/labels/label_image.h"
#include "mesamis/labels/pair_levels.h"
#include "mesamis/labels/probable_memberships.h"
#include "mesamis/method/follow_partition.h"
#include "mesamis/method/label_mesh.h"
#include "mesamis/method/passes.h"
#include "mesamis/method/prepare.h"
#include "mesamis/segment/grid_amis.h"
#include "mesamis/surface/grid_partition.h"
#include "mesamis/surface/select_parts.h"
#include "mesamis/surface/smooth_memberships.h"

namespace mesamis {
namespace {

constexpr double kMargin = 2.5;  // voxels, of the labels or of the scan
constexpr std::size_t kMostObjects = 4096;
constexpr double kMostMargin = 50;          // voxels of the scan
constexpr double kToleranceOfLabels = 0.1;  // voxels: they are no more exact
constexpr double kReach = 2;                // margins that a label may flow

/// The layers of those segments, increasing.
std::vector<Index> layers_of(const std::vector<Segment>& segments) {
  std::vector<Index> layers;
  layers.reserve(segments.size());
  for (const Segment& s : segments) layers.push_back(s.layer);
  std::sort(layers.begin(), layers.end());
  layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
  return layers;
}

/// Whether a label of a layer was chosen.
std::vector<char> marks_of(const std::vector<Segment>& chosen, Index layer) {
  std::vector<char> marks(static_cast<std::size_t>(kMaxLabel) + 1, 0);
  for (const Segment& s : chosen) {
    if (s.layer == layer) marks[static_cast<std::size_t>(s.label)] = 1;
  }
  return marks;
}

void bring_to_world(const VoxelGrid& grid, PartitionSurface& partition) {
  parallel_for(partition.points.size(),
               [&](std::size_t p) { partition.points[p] = grid.to_world(partition.points[p]); });
  if (determinant(grid.direction) >= 0) return;
  for (Triangle& t : partition.triangles) std::swap(t[1], t[2]);
}

/// Native units half way between what is chosen and what is not; nothing where they are alike.
std::optional<double> level_between(const Volume& scan, std::span<const std::uint16_t> labels,
                                    const std::vector<char>& chosen) {
  std::vector<double> in, out;
  for (std::size_t n = 0; n < labels.size(); ++n) {
    (chosen[labels[n]] != 0 ? in : out).push_back(scan.samples[n]);
  }
  if (in.empty() || out.empty()) return std::nullopt;
  const double a = median(in), b = median(out);
  return a == b ? std::nullopt : std::optional((a + b) / 2);
}

/// The edges of an image, one v per voxel, and what was prepared for it.
struct Edges {
  Prepared prepared;
  std::vector<float> v;
};

/// @param settings  with a level, or the run looks for one of its own.
Edges find_edges(const Volume& scan, Settings settings) {
  settings.crop = {};
  settings.stride = {1, 1, 1};
  settings.preview = true;  // no mesh is made
  settings.surface = SurfaceKind::kSolid;
  if (settings.threshold_rule == ThresholdRule::kAuto) {
    settings.threshold_rule = ThresholdRule::kNone;
  }
  Edges edges{prepare_image(scan, settings), {}};
  const RunInput run(edges.prepared);
  const Parameters& p = run.parameters;
  const KuhnGrid grid{run.grey.size, (1 / p.unit_mm) * run.grey.spacing};
  edges.v = run_amis_on_grid(grid, run.grey.samples, run.draft_options()).v;
  return edges;
}

CropRange range_of(const LabelBlock& block) {
  CropRange range;
  for (std::size_t a = 0; a < 3; ++a) {
    range.begin[a] = block.begin[a];
    range.end[a] = block.begin[a] + block.size[a];
  }
  return range;
}

std::string name_of(const LabelMap& map, Index layer, Index label) {
  for (const Segment& s : map.segments) {
    if (s.layer == layer && s.label == label) return s.name;
  }
  return {};
}

/// The whole of a run on labels, with or without an image.
class LabelRun {
 public:
  LabelRun(const LabelRequest& request, const Settings& settings, const Progress& progress)
      : settings_(settings),
        progress_(progress),
        labels_(request.map),
        probabilities_(request.probabilities),
        wants_mesh_(request.mesh && !settings.preview),
        chosen_(request.chosen.empty() ? request.map.segments : request.chosen) {
    require_chosen();
  }

  LabelResult with_image(const VolumeView& scan, double margin) {
    Stopwatch all, watch;
    (void)Stage(progress_, "preparation");
    result_.has_image = true;
    result_.margin = margin;
    const LabelMap on_scan = labels_on(labels_, scan);
    const LabelBlock block = clipped(require_block(on_scan, margin), scan);
    const CropRange range = range_of(block);
    const Volume part = crop(scan, range);
    std::optional<Edges> edges;  // of a given level they are those of all layers
    for (const Index layer : layers_of(chosen_)) {
      const std::vector<char> marks = marks_of(chosen_, layer);
      auto labels = labels_in(on_scan, layer, block);
      if (!edges || !settings_.level) edges = find_edges(part, with_level(part, labels, marks));
      result_.parameters = edges->prepared.parameters;
      result_.parameters.preview = settings_.preview;
      result_.parameters.min_volume = settings_.min_volume.value_or(0);
      result_.parameters.crop = range;
      result_.image = edges->prepared.measured;
      result_.seconds.prepare += watch.lap();
      place_by_image(layer, std::move(labels), marks, *edges, watch);
    }
    if (wants_mesh_) make_mesh(part, range);
    result_.seconds.mesh = watch.lap();
    result_.seconds.total = all.lap();
    return std::move(result_);
  }

  LabelResult alone() {
    Stopwatch all, watch;
    (void)Stage(progress_, "preparation");
    const LabelBlock block = require_block(labels_, 0);
    const VoxelGrid grid = grid_of(labels_, block);
    for (const Index layer : layers_of(chosen_)) {
      const std::vector<char> marks = marks_of(chosen_, layer);
      auto labels = labels_in(labels_, layer, block);
      result_.seconds.prepare += watch.lap();
      (void)Stage(progress_, "smoothing the labels");
      const GridMemberships memberships = without_image(grid, labels);
      result_.seconds.flow += watch.lap();
      (void)Stage(progress_, "surface");
      PartitionSurface partition = extract_partition_on_grid(memberships);
      std::vector<BoundaryGuide> none(partition.points.size());
      partition = only_chosen(partition, marks, none);
      bring_to_world(grid, partition);
      result_.seconds.surface += watch.lap();
      finish(layer, std::move(partition), labels_.voxel_size(), nullptr);
      result_.seconds.printable += watch.lap();
    }
    result_.seconds.total = all.lap();
    return std::move(result_);
  }

 private:
  /// A map of too many objects is no label map.
  void require_chosen() const {
    if (chosen_.size() > kMostObjects) {
      throw InputError("labels: expected at most " + std::to_string(kMostObjects) +
                       " objects, found " + std::to_string(chosen_.size()) +
                       "; choose some of them");
    }
    std::set<std::pair<Index, Index>> known, seen;
    for (const Segment& s : labels_.segments) known.emplace(s.layer, s.label);
    for (const Segment& s : chosen_) {
      const std::pair key(s.layer, s.label);
      if (known.count(key) == 0 || !seen.insert(key).second) {
        throw InputError("labels: expected each chosen object once and of the map, found '" +
                         s.name + "'" + (known.count(key) == 0 ? " of another" : " twice"));
      }
    }
  }

  /// The settings with a level: the given one, or that between the chosen labels and the rest.
  Settings with_level(const Volume& scan, std::span<const std::uint16_t> labels,
                      const std::vector<char>& marks) const {
    Settings settings = settings_;
    if (!settings.level) settings.level = level_between(scan, labels, marks);
    return settings;
  }

  LabelBlock require_block(const LabelMap& map, double room) const {
    const auto block = block_around(map, chosen_, room);
    if (block) return *block;
    throw InputError("labels: expected voxels of " +
                     (chosen_.size() == 1 ? "'" + chosen_.front().name + "'" : "chosen labels") +
                     " within the grid, found none");
  }

  /// Where the boundaries are by the labels alone.
  /// @param labels  of the grid; with probabilities they become those that win there.
  GridMemberships without_image(const VoxelGrid& grid, std::vector<std::uint16_t>& labels) const {
    if (probabilities_ == nullptr) return smooth_memberships({grid.size, grid.spacing, labels});
    GridMemberships found = probable_memberships(*probabilities_, grid);
    labels = winning_labels(found);
    return found;
  }

  void place_by_image(Index layer, std::vector<std::uint16_t> labels,
                      const std::vector<char>& marks, const Edges& edges, Stopwatch& watch) {
    (void)Stage(progress_, "flow of the labels");
    const Parameters& p = edges.prepared.parameters;
    const VoxelGrid& voxels = edges.prepared.grey;
    const GridMemberships smooth = without_image(voxels, labels);
    const LabelGrid grid{voxels.size, voxels.spacing, labels};
    const auto weight = label_confidence(grid, result_.margin);
    const FlowOptions flow{p.functional.beta, p.functional.eta, p.unit_mm, kReach * result_.margin};
    FlowReport solved;
    const GridMemberships memberships =
        flow_memberships(grid, {smooth, weight, edges.v}, flow, &solved);
    result_.flow_converged &= solved.solver_converged;
    if (wants_mesh_) images_.push_back(label_image(memberships, edges.prepared.grey));
    result_.seconds.flow += watch.lap();
    (void)Stage(progress_, "surface");
    const RunInput run(edges.prepared);
    PartitionSurface partition = extract_partition_on_grid(memberships);
    const auto pairs = measure_pair_levels(partition, run.image);
    record_boundaries(layer, pairs, marks, run);
    auto guides = guides_of_points(partition, pairs, run.error.noise);
    partition = only_chosen(partition, marks, guides);
    if (settings_.follow) {
      partition = follow_image(std::move(partition), run.image, guides, run.error.noise);
    }
    bring_to_world(run.grey, partition);
    result_.seconds.surface += watch.lap();
    finish(layer, std::move(partition), run.grey.voxel_size(), &run);
    result_.seconds.printable += watch.lap();
  }

  void make_mesh(const Volume& part, const CropRange& range) {
    Settings settings = settings_;
    settings.crop = {};
    settings.level = result_.parameters.level;
    settings.surface = SurfaceKind::kSolid;
    result_.mesh = mesh_beside_labels(part, images_, settings, progress_);
    result_.mesh->parameters.crop = range;
  }

  void record_boundaries(Index layer, const std::vector<PairLevel>& pairs,
                         const std::vector<char>& marks, const RunInput& run) {
    const GreyMap& grey = run.parameters.grey;
    for (const PairLevel& pair : pairs) {
      if (marks[static_cast<std::size_t>(pair.sides[0])] == 0 &&
          marks[static_cast<std::size_t>(pair.sides[1])] == 0) {
        continue;
      }
      result_.boundaries.push_back(
          {name_of(labels_, layer, pair.sides[0]), name_of(labels_, layer, pair.sides[1]),
           grey.to_native(pair.level), pair.contrast / grey.grey_per_native(),
           settings_.follow && shows_edge(pair, run.error.noise)});
    }
  }

  /// Decimation, and a surface for each object.
  /// @param voxel  mm: of the scan, or of the labels.
  void finish(Index layer, PartitionSurface partition, double voxel, const RunInput* run) {
    std::map<Index, std::int64_t> extracted;
    for (const auto& sides : partition.sides) {
      for (const Index side : sides) ++extracted[side];
    }
    decimate(partition, voxel, run);
    std::vector<Index> labels;
    for (const Segment& segment : chosen_) {
      if (segment.layer == layer) labels.push_back(segment.label);
    }
    std::vector<TriMesh> surfaces = object_surfaces(partition, labels);
    auto surface = surfaces.begin();
    for (const Segment& segment : chosen_) {
      if (segment.layer != layer) continue;
      LabelledObject object{segment, selected(std::move(*surface++)), {}, extracted[segment.label]};
      if (object.surface.triangles.empty()) continue;
      if (run != nullptr) {
        ErrorOptions delivered = run->error;
        delivered.decimated = decimated_;
        object.expected_error = expected_error(object.surface, run->image, delivered);
      }
      result_.objects.push_back(std::move(object));
    }
  }

  void decimate(PartitionSurface& partition, double voxel, const RunInput* run) {
    Parameters& p = result_.parameters;
    decimated_ = 0;
    p.tolerance = settings_.tolerance.value_or(default_tolerance_of(partition, voxel, run));
    p.triangles = settings_.triangles.value_or(0);
    if (p.tolerance == 0 || partition.triangles.empty()) return;
    (void)Stage(progress_, "decimation");
    std::vector<Vec3> rounded = round_together(partition.points);
    double shift = 0;
    for (std::size_t n = 0; n < rounded.size(); ++n) {
      shift = std::max(shift, norm(rounded[n] - partition.points[n]));
    }
    partition.points = std::move(rounded);
    DecimateOptions options;
    options.tolerance = std::max(0.0, p.tolerance - shift);
    options.triangles = p.triangles;
    options.progress = progress_;
    options.quick = settings_.preview && std::isfinite(options.tolerance);
    DecimateReport report;
    partition = decimate_partition(partition, options, &report);
    decimated_ = shift + std::max(report.original_to_result, report.result_to_original);
    result_.decimated = std::max(result_.decimated, decimated_);
  }

  double default_tolerance_of(const PartitionSurface& partition, double voxel,
                              const RunInput* run) const {
    if (settings_.triangles) return std::numeric_limits<double>::infinity();
    if (run == nullptr) return kToleranceOfLabels * voxel;
    const TriMesh all{partition.points, partition.triangles};
    const double error = mean_expected_error(*run, all);
    return default_tolerance(voxel, error, settings_.accuracy.value_or(0));
  }

  /// The parts that the settings leave; unless they say so, all of them.
  TriMesh selected(TriMesh surface) const {
    const PartSelection wanted{settings_.min_volume.value_or(0), settings_.keep_largest,
                               settings_.fill_cavities};
    const bool all = wanted.volume_min == 0 && wanted.keep_largest == 0 && !wanted.fill_cavities;
    if (all || surface.triangles.empty()) return surface;
    return select_parts(surface, wanted);
  }

  const Settings& settings_;
  const Progress& progress_;
  const LabelMap& labels_;
  const Probabilities* probabilities_;  // or null
  bool wants_mesh_;
  std::vector<Segment> chosen_;
  std::vector<Volume> images_;  // of the layers, for the mesh
  double decimated_ = 0;        // of the present layer, mm
  LabelResult result_;
};

}  // namespace

double label_margin(const VoxelGrid& scan, const VoxelGrid& labels) {
  const double voxel = scan.voxel_size();
  return std::min(kMostMargin * voxel, kMargin * std::max(labels.voxel_size(), voxel));
}

LabelResult find_labelled_objects(const VolumeView& scan, const LabelRequest& request,
                                  const Settings& settings, const Progress& progress) {
  require_usable(scan);
  require_valid(request.map);
  const double margin = request.margin.value_or(label_margin(scan, request.map));
  if (!(margin > 0 && margin <= kMostMargin * scan.voxel_size())) {
    throw InputError("margin: expected more than 0 and at most " +
                     std::to_string(kMostMargin * scan.voxel_size()) + " mm, found " +
                     std::to_string(margin));
  }
  return LabelRun(request, settings, progress).with_image(scan, margin);
}

LabelResult surfaces_of_labels(const LabelRequest& request, const Settings& settings,
                               const Progress& progress) {
  require_valid(request.map);
  return LabelRun(request, settings, progress).alone();
}

}  // namespace mesamis
