// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/label_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/fem/grid_amis.h"
#include "mesamis/labels/flow_memberships.h"
#include "mesamis/labels/label_block.h"
#include "mesamis/labels/label_confidence.h"
#include "mesamis/labels/label_image.h"
#include "mesamis/labels/pair_levels.h"
#include "mesamis/labels/probable_memberships.h"
#include "mesamis/method/finish_labels.h"
#include "mesamis/method/follow_partition.h"
#include "mesamis/method/label_choice.h"
#include "mesamis/method/label_mesh.h"
#include "mesamis/method/label_run.h"
#include "mesamis/method/passes.h"
#include "mesamis/method/prepare.h"
#include "mesamis/surface/extract_net.h"
#include "mesamis/surface/grid_partition.h"
#include "mesamis/surface/join_diagonals.h"
#include "mesamis/surface/match_volumes.h"
#include "mesamis/surface/open_contacts.h"
#include "mesamis/surface/smooth_memberships.h"

namespace mesamis::detail::method {
namespace {

constexpr double kMargin = 2.5;  // voxels, of the labels or of the scan
constexpr std::size_t kMostObjects = 4096;
constexpr double kMostMargin = 50;       // voxels of the scan
constexpr double kReach = 2;             // margins that a label may flow
constexpr double kReachOfFit = 0.64;     // margins in which a fitted surface looks for edges
constexpr double kReachAfterFlow = 1.6;  // voxels, the same
constexpr double kContrastKept = 0.9;    // of a boundary's, by labels that flow to an edge
constexpr int kDepthOfContacts = 2;      // points of a net, about a voxel from each other
constexpr double kGapOfContacts = 0.1;   // voxels

void bring_to_world(const VoxelGrid& grid, PartitionSurface& partition) {
  parallel_for(partition.points.size(),
               [&](std::size_t p) { partition.points[p] = grid.to_world(partition.points[p]); });
  if (determinant(grid.direction) >= 0) return;
  for (Triangle& t : partition.triangles) std::swap(t[1], t[2]);
}

/// What was prepared of an image, the level of its sheets, and its edges, one v per voxel, where
/// labels flow to them.
struct Edges {
  Prepared prepared;
  fit::SheetLevel sheets;
  std::vector<float> v;
};

/// At which level sheets were lifted, if they were.
fit::SheetLevel sheets_of(const Chosen& choice) {
  const Parameters& p = choice.parameters;
  if (!p.restore) return {};
  const ObjectContrast& contrast = choice.object.contrast;
  return {p.grey.to_grey(contrast.half_maximum()),
          contrast.difference() * p.grey.grey_per_native()};
}

Edges find_edges(const Volume& scan, const Chosen& choice, bool flows) {
  Edges edges{prepare_slab(scan, {}, choice), sheets_of(choice), {}};
  if (!flows) return edges;
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

/// The boundaries between objects; a net where they are smoothed.
PartitionSurface extract(const LabelRun& run, Index layer, const GridMemberships& memberships) {
  if (!run.smooths()) return extract_partition_on_grid(memberships);
  return extract_net_on_grid(memberships, {.chosen = marks_of(run.chosen, layer)});
}

/// What is not worth a contact is opened, where boundaries are smoothed.
PartitionSurface without_narrow_contacts(const LabelRun& run, Index layer, const VoxelGrid& grid,
                                         PartitionSurface partition) {
  if (!run.smooths() || run.settings.keep_topology) return partition;
  const ContactOptions options{.depth = kDepthOfContacts,
                               .gap = kGapOfContacts * grid.shortest_side(),
                               .in_file = [&](const Vec3& p) { return rounded(grid.to_world(p)); }};
  return open_narrow_contacts(std::move(partition), marks_of(run.chosen, layer), options);
}

LabelBlock require_block(const LabelRun& run, const LabelMap& map) {
  if (run.request.extracted != nullptr) return run.request.extracted->block;
  const auto block = block_around(map, run.chosen, run.margin);
  if (!block) refuse_empty(run.chosen);
  return *block;
}

/// Where the boundaries are by the labels alone.
/// @param labels  of the grid; with probabilities they become those that win there.
GridMemberships without_image(const LabelRun& run, const VoxelGrid& grid,
                              std::vector<std::uint16_t>& labels, const SmoothOptions& how) {
  const Probabilities* probabilities = run.request.probabilities;
  if (probabilities == nullptr) {
    if (!run.settings.keep_topology) labels = join_diagonals({grid.size, grid.spacing, labels});
    return smooth_memberships({grid.size, grid.spacing, labels}, how);
  }
  GridMemberships found = probable_memberships(*probabilities, grid);
  labels = winning_labels(found);
  return found;
}

/// Whether the image places the boundary of a pair; else the labels do.
bool is_followed(const LabelRun& run, const PairLevel& pair, double noise) {
  return run.settings.follow && shows_edge(pair, noise);
}

std::vector<LabelBoundary> boundaries_of(const LabelRun& run, Index layer,
                                         const std::vector<PairLevel>& pairs,
                                         const RunInput& input) {
  const GreyMap& grey = input.parameters.grey;
  const LabelMap& map = run.request.map;
  const std::vector<char> marks = marks_of(run.chosen, layer);
  std::vector<LabelBoundary> found;
  for (const PairLevel& pair : pairs) {
    const auto [one, other] = pair.sides;
    if (marks[static_cast<std::size_t>(one)] == 0 && marks[static_cast<std::size_t>(other)] == 0) {
      continue;
    }
    found.push_back({name_of(map, layer, one), name_of(map, layer, other),
                     grey.to_native(pair.level), pair.contrast / grey.grey_per_native(),
                     is_followed(run, pair, input.noise)});
  }
  return found;
}

/// Of each label whether the image places a boundary of it.
std::vector<char> labels_placed(const LabelRun& run, const std::vector<PairLevel>& pairs,
                                double noise) {
  std::vector<char> placed(std::size_t{kMaxLabel} + 1, 0);
  for (const PairLevel& pair : pairs) {
    if (!is_followed(run, pair, noise)) continue;
    for (const Index side : pair.sides) placed[static_cast<std::size_t>(side)] = 1;
  }
  return placed;
}

/// Whether a boundary has left its edge: the image shows less there than where it was.
bool has_left(const PairLevel& before, const std::vector<PairLevel>& after) {
  const auto same = std::find_if(after.begin(), after.end(),
                                 [&](const PairLevel& pair) { return pair.sides == before.sides; });
  const double sign = before.contrast < 0 ? -1 : 1;
  return same == after.end() || sign * same->contrast < kContrastKept * std::abs(before.contrast);
}

/// Of each label whether a flow leaves it less than half of its voxels.
std::vector<char> labels_lost(const LabelGrid& grid, const GridMemberships& flowed) {
  std::vector<std::int64_t> before(std::size_t{kMaxLabel} + 1, 0), after = before;
  for (std::size_t n = 0; n < grid.labels.size(); ++n) {
    const auto material = static_cast<std::size_t>(flowed.material[n]);
    ++before[grid.labels[n]];
    ++after[static_cast<std::size_t>(flowed.label[material])];
  }
  std::vector<char> lost(before.size(), 0);
  for (std::size_t label = 1; label < lost.size(); ++label) {
    lost[label] = 2 * after[label] < before[label] ? 1 : 0;
  }
  return lost;
}

/// The labels flow to the edges of the image, but where it shows none between two, and where they
/// would leave it or lose more than half: there they stay.
/// @param found  of a layer: gets the boundaries, and whether the flow has converged.
GridMemberships flow_to_edges(const LabelRun& run, const GridMemberships& smooth,
                              const LabelGrid& grid, const Edges& edges, LayerBoundaries& found) {
  const RunInput input(edges.prepared);
  const Parameters& p = input.parameters;
  const FlowOptions how{p.functional.beta, p.functional.eta, p.unit_mm, kReach * run.margin};
  std::vector<PairLevel> seen;
  std::vector<LabelPair> unseen;
  for (const PairLevel& pair :
       measure_pair_levels(extract(run, found.layer, smooth), input.image)) {
    if (shows_edge(pair, input.noise)) {
      seen.push_back(pair);
    } else {
      unseen.push_back(pair.sides);
    }
  }
  const auto flow = [&] {
    const auto weight = label_confidence(grid, run.margin, unseen);
    FlowReport solved;
    GridMemberships flowed = flow_memberships(grid, {smooth, weight, edges.v}, how, &solved);
    found.converged = solved.solver_converged;
    found.partition = extract(run, found.layer, flowed);
    return flowed;
  };
  GridMemberships flowed = flow();
  const std::vector<PairLevel> after = measure_pair_levels(found.partition, input.image);
  const std::vector<char> lost = labels_lost(grid, flowed);
  const std::size_t before = unseen.size();
  for (const PairLevel& pair : seen) {
    const auto [one, other] = pair.sides;
    if (has_left(pair, after) || lost[static_cast<std::size_t>(one)] != 0 ||
        lost[static_cast<std::size_t>(other)] != 0) {
      unseen.push_back(pair.sides);
    }
  }
  if (unseen.size() > before) flowed = flow();
  return flowed;
}

/// Moves boundaries on to the image.
void move_to_image(const LabelRun& run, const Edges& edges,
                   const std::vector<BoundaryGuide>& guides, LayerBoundaries& found) {
  if (!run.settings.follow) return;
  const RunInput input(edges.prepared);
  PartitionSurface before = std::move(found.partition);
  if (!run.settings.fit) {
    found.partition = follow_image(std::move(before), input.image, guides, input.noise);
    return;
  }
  double reach = kReachOfFit * run.margin / input.grey.voxel_size();
  if (!run.starts_from_labels(input.grey)) reach = std::min(reach, kReachAfterFlow);
  found.partition =
      fit_boundaries(std::move(before), input.image, {guides, found.volumes, reach, edges.sheets});
}

/// Boundaries between all labels, in the block's axes: of the labels alone where they start
/// from these, else where labels flow to.
LayerBoundaries extract_in_image(const LabelRun& run, Index layer,
                                 std::vector<std::uint16_t> labels, const Edges& edges) {
  LayerBoundaries found{layer, {}};
  const VoxelGrid& voxels = edges.prepared.grey;
  const bool starts_from_labels = run.starts_from_labels(voxels);
  GridMemberships memberships =
      without_image(run, voxels, labels, starts_from_labels ? kBeforeNet : SmoothOptions{});
  if (starts_from_labels) {
    found.partition = extract(run, layer, memberships);
    found.volumes =
        volumes_of(label_eighths({voxels.size, voxels.spacing, labels}), voxels.spacing);
  } else {
    const LabelGrid grid{voxels.size, voxels.spacing, labels};
    memberships = flow_to_edges(run, memberships, grid, edges, found);
  }
  if (run.makes_mesh()) found.image = label_image(memberships, voxels);
  return found;
}

/// The same, where they were extracted slab by slab.
LayerBoundaries extracted_beforehand(const LabelRun& run, Index layer) {
  LayerPartition extracted = run.request.extracted->of_layer(layer);
  return {layer, std::move(extracted.partition), std::move(extracted.volumes)};
}

/// Boundaries of the labels, as the image places them.
LayerBoundaries place_by_image(const LabelRun& run, LayerBoundaries found, const Edges& edges,
                               LabelResult::Seconds& seconds) {
  Stopwatch watch;
  run.begin("surface");
  const Index layer = found.layer;
  const RunInput input(edges.prepared);
  const auto pairs = measure_pair_levels(found.partition, input.image);
  found.boundaries = boundaries_of(run, layer, pairs, input);
  found.placed = labels_placed(run, pairs, input.noise);
  found.partition = without_narrow_contacts(run, layer, input.grey, std::move(found.partition));
  auto guides = guides_of_points(found.partition, pairs, input.noise);
  found.partition = only_chosen(found.partition, marks_of(run.chosen, layer), guides);
  move_to_image(run, edges, guides, found);
  bring_to_world(input.grey, found.partition);
  seconds.surface += watch.lap();
  return found;
}

/// The boundaries between the labels of a layer, which may have the steps of their voxels.
LayerPartition extract_by_labels(const LabelRun& run, Index layer, const LabelBlock& block,
                                 LabelResult::Seconds& seconds) {
  if (run.request.extracted != nullptr) return run.request.extracted->of_layer(layer);
  Stopwatch watch;
  const LabelMap& map = run.request.map;
  auto labels = labels_in(map, layer, block);
  if (run.smooths()) keep_chosen(marks_of(run.chosen, layer), labels);
  run.begin("smoothing the labels");
  const VoxelGrid grid = grid_of(map, block);
  const GridMemberships memberships =
      without_image(run, grid, labels, run.smooths() ? kBeforeNet : SmoothOptions{});
  seconds.flow += watch.lap();
  run.begin("surface");
  LayerPartition found{extract(run, layer, memberships),
                       volumes_of(label_eighths({grid.size, grid.spacing, labels}), grid.spacing)};
  seconds.surface += watch.lap();
  return found;
}

/// Boundaries of the chosen labels, smooth.
/// @param grid  of the block that they were extracted in.
LayerBoundaries place_by_labels(const LabelRun& run, Index layer, const VoxelGrid& grid,
                                LayerPartition extracted) {
  PartitionSurface partition =
      without_narrow_contacts(run, layer, grid, std::move(extracted.partition));
  std::vector<BoundaryGuide> none(partition.points.size());
  partition = only_chosen(partition, marks_of(run.chosen, layer), none);
  if (run.smooths()) partition = smooth_boundaries(std::move(partition), grid, extracted.volumes);
  bring_to_world(grid, partition);
  return {layer, std::move(partition)};
}

/// What is chosen for all layers, before any of them.
Parameters parameters_of(const LabelRun& run, const Prepared& prepared, const CropRange& range) {
  Parameters p = prepared.parameters;
  p.preview = run.settings.preview;
  p.min_volume = least_volume(run);
  p.crop = range;
  return p;
}

/// Around the chosen labels, adapted to the image and to the labels of all layers.
Result mesh_of(const LabelRun& run, const Volume& part, std::vector<LayerBoundaries>& layers,
               const Parameters& p) {
  std::vector<Volume> images;
  images.reserve(layers.size());
  for (LayerBoundaries& layer : layers) images.push_back(std::move(*layer.image));
  Settings settings = run.settings;
  settings.crop = {};
  settings.local_level = false;
  settings.surface = SurfaceKind::kSolid;
  const KnownLevel level{p.level, LevelSource::kLabels};
  Result mesh = mesh_beside_labels(part, images, {settings, level}, run.progress);
  mesh.parameters.crop = p.crop;
  return mesh;
}

LabelResult with_image(const LabelRun& run, const VolumeView& scan) {
  Stopwatch all, watch;
  run.begin("preparation");
  LabelResult result;
  result.has_image = true;
  result.margin = run.margin;
  const bool on_its_grid = run.request.extracted != nullptr;
  const LabelMap brought = on_its_grid ? LabelMap{} : labels_on(run.request.map, scan);
  const LabelMap& on_scan = on_its_grid ? run.request.map : brought;
  const LabelBlock block = clipped(require_block(run, on_scan), scan);
  const CropRange range = range_of(block);
  Volume part = crop(scan, range);
  const Chosen choice = choose_beside_labels(scan, run.of_image,
                                             values_of_labels(part, {on_scan, block, run.chosen}));
  const Edges edges = find_edges(part, choice, !run.starts_from_labels(scan));
  if (!run.makes_mesh()) part.samples = {};
  const RunInput input(edges.prepared);
  result.parameters = parameters_of(run, edges.prepared, range);
  result.image = edges.prepared.measured;
  result.seconds.prepare = watch.lap();
  std::vector<LayerBoundaries> layers;
  for (const Index layer : layers_of(run.chosen)) {
    watch.lap();
    run.begin("flow of the labels");
    LayerBoundaries extracted =
        on_its_grid ? extracted_beforehand(run, layer)
                    : extract_in_image(run, layer, labels_in(on_scan, layer, block), edges);
    result.seconds.flow += watch.lap();
    layers.push_back(place_by_image(run, std::move(extracted), edges, result.seconds));
  }
  watch.lap();
  if (run.makes_mesh()) result.mesh = mesh_of(run, part, layers, result.parameters);
  result.seconds.mesh = watch.lap();
  finish_layers(run, std::move(layers), &input, result);
  result.seconds.total = all.lap();
  return result;
}

LabelResult by_labels(const LabelRun& run) {
  Stopwatch all, watch;
  run.begin("preparation");
  LabelResult result;
  result.parameters = parameters_asked(run.settings);
  result.parameters.min_volume = least_volume(run);
  const LabelBlock block = require_block(run, run.request.map);
  const VoxelGrid grid = grid_of(run.request.map, block);
  result.seconds.prepare = watch.lap();
  std::vector<LayerBoundaries> layers;
  for (const Index layer : layers_of(run.chosen)) {
    LayerPartition extracted = extract_by_labels(run, layer, block, result.seconds);
    watch.lap();
    layers.push_back(place_by_labels(run, layer, grid, std::move(extracted)));
    result.seconds.surface += watch.lap();
  }
  finish_layers(run, std::move(layers), nullptr, result);
  result.seconds.total = all.lap();
  return result;
}

}  // namespace

std::vector<Index> layers_of(const std::vector<Segment>& segments) {
  std::vector<Index> layers;
  layers.reserve(segments.size());
  for (const Segment& s : segments) layers.push_back(s.layer);
  sort_once(layers);
  return layers;
}

std::vector<char> marks_of(const std::vector<Segment>& chosen, Index layer) {
  std::vector<char> marks(static_cast<std::size_t>(kMaxLabel) + 1, 0);
  for (const Segment& s : chosen) {
    if (s.layer == layer) marks[static_cast<std::size_t>(s.label)] = 1;
  }
  return marks;
}

void require_solids(const Settings& settings) {
  if (settings.surface == SurfaceKind::kSolid) return;
  throw InputError("surface: expected solid for several objects, found band");
}

void require_chosen(const std::vector<Segment>& chosen, const LabelMap& map) {
  if (chosen.size() > kMostObjects) {
    throw InputError("labels: expected at most " + std::to_string(kMostObjects) +
                     " objects, found " + std::to_string(chosen.size()) + "; choose some of them");
  }
  std::set<std::pair<Index, Index>> known, seen;
  for (const Segment& s : map.segments) known.emplace(s.layer, s.label);
  for (const Segment& s : chosen) {
    const std::pair key(s.layer, s.label);
    if (known.count(key) == 0 || !seen.insert(key).second) {
      throw InputError("labels: expected each chosen object once and of the map, found '" + s.name +
                       "'" + (known.count(key) == 0 ? " of another" : " twice"));
    }
  }
}

[[noreturn]] void refuse_empty(const std::vector<Segment>& chosen) {
  throw InputError(
      "labels: expected voxels of " +
      (chosen.size() == 1 ? "'" + chosen.front().name + "'" : std::string("chosen labels")) +
      " within the grid, found none");
}

double label_margin(const VoxelGrid& scan, const VoxelGrid& labels) {
  const double voxel = scan.voxel_size();
  return std::min(kMostMargin * voxel, kMargin * std::max(labels.voxel_size(), voxel));
}

double margin_of(const std::optional<double>& asked, const VoxelGrid& scan,
                 const VoxelGrid& labels) {
  const double margin = asked.value_or(label_margin(scan, labels));
  const double most = kMostMargin * scan.voxel_size();
  if (margin > 0 && margin <= most) return margin;
  throw InputError("margin: expected more than 0 and at most " + std::to_string(most) +
                   " mm, found " + std::to_string(margin));
}

bool starts_from_labels(const Settings& settings, const VoxelGrid& scan, const VoxelGrid& labels) {
  return settings.fit && labels.voxel_size() <= kCoarsestFitted * scan.voxel_size();
}

LabelResult find_labelled_objects(const VolumeView& scan, const LabelRequest& request,
                                  const ImageSettings& settings, const Progress& progress) {
  require_usable(scan);
  require_valid(request.map);
  LabelRun run(request, settings, progress);
  run.margin = margin_of(request.margin, scan, request.map);
  return with_image(run, scan);
}

LabelResult surfaces_of_labels(const LabelRequest& request, const Settings& settings,
                               const Progress& progress) {
  if (request.extracted == nullptr) require_valid(request.map);
  return by_labels({request, settings, progress});
}

}  // namespace mesamis::detail::method
