// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/label_surfaces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/labels/flow_memberships.h"
#include "mesamis/labels/label_confidence.h"
#include "mesamis/labels/pair_levels.h"
#include "mesamis/method/follow_partition.h"
#include "mesamis/method/passes.h"
#include "mesamis/method/prepare.h"
#include "mesamis/segment/grid_amis.h"
#include "mesamis/surface/grid_partition.h"
#include "mesamis/surface/smooth_memberships.h"

namespace mesamis {
namespace {

constexpr double kMarginOfLabels = 2.5, kMarginOfScan = 2.5;  // voxels
constexpr Index kRoom = 4;    // voxels around the labels and their margin
constexpr double kReach = 2;  // margins that a label may flow

/// The segments that are meant.
std::vector<Segment> chosen_of(const LabelMap& labels, const LabelRequest& request) {
  return request.chosen.empty() ? labels.segments : request.chosen;
}

/// The layers of those segments, increasing.
std::vector<Index> layers_of(const std::vector<Segment>& segments) {
  std::vector<Index> layers;
  for (const Segment& s : segments) layers.push_back(s.layer);
  std::sort(layers.begin(), layers.end());
  layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
  return layers;
}

/// The voxels of the chosen segments and some around them; empty if there are none.
std::optional<CropRange> range_around(const LabelMap& map, const std::vector<Segment>& chosen,
                                      double margin) {
  std::optional<CropRange> all;
  for (const Segment& segment : chosen) {
    const auto range = range_of(map, segment);
    if (!range) continue;
    if (!all) all = range;
    for (std::size_t a = 0; a < 3; ++a) {
      all->begin[a] = std::min(all->begin[a], range->begin[a]);
      all->end[a] = std::max(all->end[a], range->end[a]);
    }
  }
  if (!all) return std::nullopt;
  for (std::size_t a = 0; a < 3; ++a) {
    const double spacing = map.spacing[static_cast<int>(a)];
    const Index room = static_cast<Index>(std::ceil(margin / spacing)) + kRoom;
    all->begin[a] = std::max(0, all->begin[a] - room);
    all->end[a] = std::min(map.size[a], all->end[a] + room);
    if (all->end[a] - all->begin[a] < 2) {  // of a flat map
      all->begin[a] = std::max(0, all->end[a] - 2);
      all->end[a] = std::min(map.size[a], all->begin[a] + 2);
    }
  }
  return all;
}

/// The part of one layer within a range.
std::vector<std::uint16_t> cropped_layer(const LabelMap& map, Index layer, const CropRange& range) {
  const auto size = cropped_size(map, range);
  std::vector<std::uint16_t> part;
  part.reserve(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
               static_cast<std::size_t>(size[2]));
  const std::vector<std::uint16_t>& from = map.layers[static_cast<std::size_t>(layer)];
  for (Index k = range.begin[2]; k < range.end[2]; ++k) {
    for (Index j = range.begin[1]; j < range.end[1]; ++j) {
      const auto row = from.begin() + static_cast<std::ptrdiff_t>(map.offset(range.begin[0], j, k));
      part.insert(part.end(), row, row + size[0]);
    }
  }
  return part;
}

/// A grid without samples: that of a range of another.
VoxelGrid cropped_grid(const VoxelGrid& grid, const CropRange& range) {
  VoxelGrid part = grid;
  part.size = cropped_size(grid, range);
  const Vec3 corner{range.begin[0] * grid.spacing.x, range.begin[1] * grid.spacing.y,
                    range.begin[2] * grid.spacing.z};
  part.origin = grid.to_world(corner);
  return part;
}

/// Whether a label of a layer was chosen.
std::vector<char> marks_of(const std::vector<Segment>& chosen, Index layer) {
  std::vector<char> marks(static_cast<std::size_t>(kMaxLabel) + 1, 0);
  for (const Segment& s : chosen) {
    if (s.layer == layer) marks[static_cast<std::size_t>(s.label)] = 1;
  }
  return marks;
}

/// The boundaries of chosen labels alone; what was not chosen is background.
PartitionSurface without_others(const PartitionSurface& all, const std::vector<char>& chosen) {
  const auto seen = [&](Index label) {
    return label > 0 && chosen[static_cast<std::size_t>(label)] != 0 ? label : 0;
  };
  PartitionSurface kept;
  std::vector<Index> number(all.points.size(), kNoIndex);
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    std::array<Index, 2> sides{seen(all.sides[t][0]), seen(all.sides[t][1])};
    if (sides[0] == sides[1]) continue;
    Triangle triangle = all.triangles[t];
    if (sides[0] > sides[1]) {
      std::swap(sides[0], sides[1]);
      std::swap(triangle[1], triangle[2]);
    }
    for (Index& p : triangle) {
      if (number[p] == kNoIndex) {
        number[p] = static_cast<Index>(kept.points.size());
        kept.points.push_back(all.points[p]);
      }
      p = number[p];
    }
    kept.triangles.push_back(triangle);
    kept.sides.push_back(sides);
  }
  return kept;
}

void bring_to_world(const VoxelGrid& grid, PartitionSurface& partition) {
  parallel_for(partition.points.size(),
               [&](std::size_t p) { partition.points[p] = grid.to_world(partition.points[p]); });
  if (determinant(grid.direction) >= 0) return;
  for (Triangle& t : partition.triangles) std::swap(t[1], t[2]);
}

/// Native units half way between what is chosen and what is not.
double level_between(const Volume& scan, std::span<const std::uint16_t> labels,
                     const std::vector<char>& chosen) {
  std::vector<double> in, out;
  for (std::size_t n = 0; n < labels.size(); ++n) {
    (chosen[labels[n]] != 0 ? in : out).push_back(scan.samples[n]);
  }
  if (in.empty() || out.empty()) return 0;
  return (median(in) + median(out)) / 2;
}

/// The edges of an image, one v per voxel, and what was prepared for it.
struct Edges {
  Prepared prepared;
  std::vector<float> v;
};

Edges find_edges(const Volume& scan, Settings settings, double level) {
  settings.crop = {};
  settings.stride = {1, 1, 1};
  settings.preview = true;  // no mesh is made
  settings.surface = SurfaceKind::kSolid;
  if (!settings.level) settings.level = level;
  if (settings.threshold_rule == ThresholdRule::kAuto)
    settings.threshold_rule = ThresholdRule::kNone;
  Edges edges{prepare_image(scan, settings), {}};
  const RunInput run(edges.prepared);
  const Parameters& p = run.parameters;
  const KuhnGrid grid{run.grey.size, (1 / p.unit_mm) * run.grey.spacing};
  edges.v = run_amis_on_grid(grid, run.grey.samples, run.draft_options()).v;
  return edges;
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
  LabelRun(const LabelMap& labels, const LabelRequest& request, const Settings& settings,
           const Progress& progress)
      : settings_(settings),
        progress_(progress),
        labels_(labels),
        chosen_(chosen_of(labels, request)) {}

  LabelResult with_image(const VolumeView& scan, double margin) {
    Stopwatch all, watch;
    (void)Stage(progress_, "preparation");
    result_.has_image = true;
    result_.margin = margin;
    const LabelMap on_scan = labels_on(labels_, scan);
    const CropRange range = require_range(on_scan, margin);
    const Volume part = crop(scan, range);
    for (const Index layer : layers_of(chosen_)) {
      const std::vector<char> marks = marks_of(chosen_, layer);
      const auto labels = cropped_layer(on_scan, layer, range);
      const Edges edges = find_edges(part, settings_, level_between(part, labels, marks));
      result_.parameters = edges.prepared.parameters;
      result_.parameters.crop = range;
      result_.image = edges.prepared.measured;
      result_.seconds.prepare += watch.lap();
      place_by_image(layer, {part.size, part.spacing, labels}, marks, edges, watch);
    }
    result_.seconds.total = all.lap();
    return std::move(result_);
  }

  LabelResult alone() {
    Stopwatch all, watch;
    (void)Stage(progress_, "preparation");
    const CropRange range = require_range(labels_, 0);
    const VoxelGrid grid = cropped_grid(labels_, range);
    result_.parameters.crop = range;
    for (const Index layer : layers_of(chosen_)) {
      const std::vector<char> marks = marks_of(chosen_, layer);
      const auto labels = cropped_layer(labels_, layer, range);
      result_.seconds.prepare += watch.lap();
      (void)Stage(progress_, "smoothing the labels");
      const GridMemberships memberships = smooth_memberships({grid.size, grid.spacing, labels});
      result_.seconds.flow += watch.lap();
      (void)Stage(progress_, "surface");
      PartitionSurface partition = without_others(extract_partition_on_grid(memberships), marks);
      bring_to_world(grid, partition);
      result_.seconds.surface += watch.lap();
      finish(layer, std::move(partition), nullptr);
      result_.seconds.printable += watch.lap();
    }
    result_.seconds.total = all.lap();
    return std::move(result_);
  }

 private:
  CropRange require_range(const LabelMap& map, double margin) const {
    const auto range = range_around(map, chosen_, margin);
    if (range) return *range;
    throw InputError("labels: expected voxels of " +
                     (chosen_.size() == 1 ? "'" + chosen_.front().name + "'" : "chosen labels") +
                     " within the grid, found none");
  }

  void place_by_image(Index layer, const LabelGrid& grid, const std::vector<char>& marks,
                      const Edges& edges, Stopwatch& watch) {
    (void)Stage(progress_, "flow of the labels");
    const Parameters& p = edges.prepared.parameters;
    const auto weight = label_confidence(grid, result_.margin);
    const FlowOptions flow{p.functional.beta, p.functional.eta, p.unit_mm};
    const GridMemberships memberships = flow_memberships(grid, smooth_memberships(grid), weight,
                                                         edges.v, kReach * result_.margin, flow);
    result_.seconds.flow += watch.lap();
    (void)Stage(progress_, "surface");
    const RunInput run(edges.prepared);
    PartitionSurface partition = extract_partition_on_grid(memberships);
    const auto pairs = measure_pair_levels(partition, run.image);
    if (settings_.follow) {
      partition = follow_image(std::move(partition), run.image, pairs, run.error.noise);
    }
    record_boundaries(layer, pairs, marks, p.grey);
    partition = without_others(partition, marks);
    bring_to_world(run.grey, partition);
    result_.seconds.surface += watch.lap();
    finish(layer, std::move(partition), &run);
    result_.seconds.printable += watch.lap();
  }

  void record_boundaries(Index layer, const std::vector<PairLevel>& pairs,
                         const std::vector<char>& marks, const GreyMap& grey) {
    for (const PairLevel& pair : pairs) {
      if (marks[static_cast<std::size_t>(pair.sides[0])] == 0 &&
          marks[static_cast<std::size_t>(pair.sides[1])] == 0) {
        continue;
      }
      result_.boundaries.push_back(
          {name_of(labels_, layer, pair.sides[0]), name_of(labels_, layer, pair.sides[1]),
           grey.to_native(pair.level), pair.contrast / grey.grey_per_native(), settings_.follow});
    }
  }

  /// Decimation, and a surface for each object.
  void finish(Index layer, PartitionSurface partition, const RunInput* run) {
    for (const Segment& segment : chosen_) {
      if (segment.layer != layer) continue;
      LabelledObject object{segment, object_surface(partition, segment.label), {}, 0};
      if (object.surface.triangles.empty()) continue;
      object.triangles_extracted = std::ssize(object.surface.triangles);
      if (run != nullptr) {
        object.expected_error = expected_error(object.surface, run->image, run->error);
      }
      result_.objects.push_back(std::move(object));
    }
  }

  const Settings& settings_;
  const Progress& progress_;
  const LabelMap& labels_;
  std::vector<Segment> chosen_;
  LabelResult result_;
};

}  // namespace

double label_margin(const VoxelGrid& scan, const VoxelGrid& labels) {
  return std::max(kMarginOfLabels * labels.voxel_size(), kMarginOfScan * scan.voxel_size());
}

LabelResult find_labelled_objects(const VolumeView& scan, const LabelMap& labels,
                                  const LabelRequest& request, const Settings& settings,
                                  const Progress& progress) {
  require_usable(scan);
  require_valid(labels);
  LabelRun run(labels, request, settings, progress);
  return run.with_image(scan, request.margin.value_or(label_margin(scan, labels)));
}

LabelResult surfaces_of_labels(const LabelMap& labels, const LabelRequest& request,
                               const Settings& settings, const Progress& progress) {
  require_valid(labels);
  return LabelRun(labels, request, settings, progress).alone();
}

}  // namespace mesamis
