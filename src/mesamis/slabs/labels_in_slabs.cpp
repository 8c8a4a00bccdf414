// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/labels_in_slabs.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/message.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/slabs/in_scratch.h"
#include "mesamis/slabs/label_tasks.h"
#include "mesamis/slabs/stages.h"
#include "mesamis/slabs/stored_labels.h"

namespace mesamis::detail::slabs {
namespace {

/// Slices of a slab, unless they are asked for; half of that where they have more voxels than this.
constexpr Index kThickSlab = 64;
constexpr std::int64_t kMostVoxels = std::int64_t{1} << 28;
/// Slices that are looked at together before there are slabs.
constexpr Index kSlicesSeen = 16;

constexpr char kMarginFile[] = "margin";

std::string range_file(Index chunk) { return "range." + std::to_string(chunk); }

/// The voxels of the chosen segments in some slices; the end is 0 where there are none.
CropRange range_in(const StoredLabels& labels, const std::vector<Segment>& chosen,
                   const SliceRange& slices) {
  const VoxelGrid& grid = labels.head();
  CropRange range{grid.size, {0, 0, 0}};
  for (const Index layer : layers_of(chosen)) {
    const std::vector<char> marks = marks_of(chosen, layer);
    const std::vector<std::uint16_t> found = labels.read(layer, slices.first, slices.count);
    for (std::size_t n = 0; n < found.size(); ++n) {
      if (marks[found[n]] == 0) continue;
      std::array<Index, 3> at = grid.voxel(n);
      at[2] += slices.first;
      for (std::size_t a = 0; a < 3; ++a) {
        range.begin[a] = std::min(range.begin[a], at[a]);
        range.end[a] = std::max(range.end[a], at[a] + 1);
      }
    }
  }
  return range;
}

/// The range of the chosen segments.
CropRange find_range(const StoredLabels& labels, const std::vector<Segment>& chosen,
                     const Scratch& scratch, Stages& stages) {
  const VoxelGrid& grid = labels.head();
  const Index slices = grid.size[2], chunks = (slices + kSlicesSeen - 1) / kSlicesSeen;
  stages.run("look", chunks, [&](Index c) {
    const Index first = c * kSlicesSeen;
    ArchiveWriter archive;
    archive.add_one(range_in(labels, chosen, {first, std::min(kSlicesSeen, slices - first)}));
    scratch.write(range_file(c), archive);
    return SlabWork{};
  });
  CropRange all{grid.size, {0, 0, 0}};
  for (Index c = 0; c < chunks; ++c) {
    const auto range = scratch.read(range_file(c)).next_one<CropRange>();
    for (std::size_t a = 0; a < 3; ++a) {
      all.begin[a] = std::min(all.begin[a], range.begin[a]);
      all.end[a] = std::max(all.end[a], range.end[a]);
    }
  }
  if (all.end[0] == 0) refuse_empty(chosen);
  return all;
}

/// Slabs of equal numbers of slices, as near as possible.
std::vector<Index> cuts_of(const LabelBlock& block, const std::optional<Index>& asked) {
  const auto [nx, ny, nz] = block.size;
  const bool wide = std::int64_t{nx} * ny * kThickSlab > kMostVoxels;
  const Index count = asked.value_or(std::max(1, nz / (wide ? kThickSlab / 2 : kThickSlab)));
  if (count < 1 || nz / count < 2) {
    throw InputError("slabs: expected at least 2 slices in each, found " + std::to_string(count) +
                     " slabs of " + std::to_string(nz) + " slices");
  }
  std::vector<Index> cuts;
  for (Index s = 0; s <= count; ++s) {
    cuts.push_back(static_cast<Index>(std::int64_t{nz} * s / count));
  }
  return cuts;
}

/// All tasks on a layer.
/// @param keep_topology  see Settings.
void run_layer(LayerRun& run, bool keep_topology, Stages& stages) {
  const Index slabs = run.count();
  const std::string of_layer = " of layer " + std::to_string(run.layer);
  const auto each = [&](const std::string& name, const auto& task) {
    stages.for_slabs(name + of_layer, slabs, [&](Index s) { return task(s); });
  };
  const auto number_parts = [&](const std::string& of) {
    stages.run("room for parts" + of + of_layer, 1, [&](Index) { return make_part_file(run); });
    each("parts" + of, [&](Index s) { return find_parts(run, s); });
    stages.for_borders("parts at borders" + of + of_layer, slabs,
                       [&](Index s) { return join_parts(run, s); });
    learn_parts(run);
  };
  number_parts("");
  if (!keep_topology) {
    each("joins", [&](Index s) { return find_joins(run, s); });
    learn_joins(run);
    if (!run.joins.empty()) number_parts(" joined");
  }
  each("steps", [&](Index s) { return find_wishes(run, s); });
  stages.run("steps removed" + of_layer, 1, [&](Index) { return let_yield(run); });
  each("memberships", [&](Index s) { return smooth_slab(run, s); });
  VolumeMatch match(volumes_of(run.parts.eighths, run.source.head().spacing), run.smoothing);
  do {
    each("volumes " + std::to_string(match.report().rounds),
         [&](Index s) { return measure_slab(run, match, s); });
  } while (match.improve(layers_of_slabs(run, match)));
  each("surface", [&](Index s) { return extract_slab(run, match, s); });
}

/// Reads labels, and leaves them in the scratch folder on the grid that they are worked on.
void bring_labels(const Scratch& scratch, const LabelSlabRequest& request,
                  const Settings& settings) {
  ReadLabels labels = request.read();
  require_valid(labels.map);
  double margin = 0;
  if (request.scan) {
    if (!starts_from_labels(settings, *request.scan, labels.map)) {
      throw InputError(message("slabs: expected labels beside a scan to be no coarser than ",
                               kCoarsestFitted, " voxels of it, and no --no-fit, found ",
                               settings.fit ? "coarser ones" : "--no-fit",
                               ": they flow in the whole image"));
    }
    margin = margin_of(request.margin, *request.scan, labels.map);
    labels.map = labels_on(labels.map, *request.scan);
  }
  store_labels(scratch, labels.map, labels.warnings);
  ArchiveWriter archive;
  archive.add_one(margin);
  scratch.write(kMarginFile, archive);
}

/// The map that was stored, with its layers.
LabelMap whole_map(const StoredLabels& labels) {
  LabelMap map = labels.head();
  Index layers = 0;
  for (const Segment& s : map.segments) layers = std::max(layers, s.layer + 1);
  for (Index layer = 0; layer < layers; ++layer) {
    map.layers.push_back(labels.read(layer, 0, map.size[2]));
  }
  return map;
}

/// What the runs on all layers know in common.
struct AllLayers {
  const std::vector<LayerRun>& runs;
  const std::vector<Segment>& chosen;
  double margin = 0;  ///< mm
};

LabelSlabResult finish(const AllLayers& found, const LabelSlabRequest& request,
                       const Settings& settings, const Progress& progress) {
  const std::vector<LayerRun>& runs = found.runs;
  const LayerRun& any = runs.front();
  const LabelMap& head = any.source.head();
  const auto extract = [&](Index layer) {
    const auto at = std::find_if(runs.begin(), runs.end(),
                                 [&](const LayerRun& run) { return run.layer == layer; });
    return LayerPartition{joined_boundaries(*at), label_volumes(*at)};
  };
  const ExtractedBoundaries extracted{any.block, extract};
  LabelSlabResult all;
  if (request.scan) {
    const LabelMap map = whole_map(any.source);
    all.result = request.find({map, found.chosen, found.margin, false, nullptr, &extracted});
  } else {
    const LabelRequest alone{head, found.chosen, {}, false, nullptr, &extracted};
    all.result = surfaces_of_labels(alone, settings, progress);
  }
  all.head = head;
  all.chosen = found.chosen;
  for (const Index cut : any.cuts) all.cuts.push_back(any.block.begin[2] + cut);
  return all;
}

std::optional<LabelSlabResult> run_through(const Scratch& scratch, const LabelSlabRequest& request,
                                           const Settings& settings, const SlabRunOptions& options,
                                           Team& team) {
  const Progress& progress = options.progress;
  Stages(scratch, team, progress, 1).run("labels", 1, [&](Index) {
    bring_labels(scratch, request, settings);
    return SlabWork{};
  });
  const StoredLabels labels(scratch);
  const std::vector<Segment> chosen = request.choose(labels.head());
  require_chosen(chosen, labels.head());
  Stages stages(scratch, team, progress,
                options.turns.value_or(parts_of(labels.head(), kVoxelsOfATurn)));
  const auto margin = scratch.read(kMarginFile).next_one<double>();
  LabelBlock block =
      block_around(labels.head(), find_range(labels, chosen, scratch, stages), margin);
  if (request.scan) block = clipped(block, *request.scan);
  const std::vector<Index> cuts = cuts_of(block, options.slabs);
  std::vector<LayerRun> runs;
  for (const Index layer : layers_of(chosen)) {
    runs.push_back({labels, scratch, layer, block, cuts});
    if (settings.fit) {
      runs.back().net = NetOptions{.chosen = marks_of(chosen, layer)};
      runs.back().smoothing = kBeforeNet;
      runs.back().only_chosen = !request.scan;
    }
    run_layer(runs.back(), settings.keep_topology, stages);
  }
  team.wait_for_all();  // all have read what rank 0 removes at the end
  if (team.rank() != 0) return std::nullopt;
  LabelSlabResult all = finish({runs, chosen, margin}, request, settings, progress);
  all.warnings = labels.warnings();
  all.slabs = stages.work_of_slabs(runs.front().count());
  return all;
}

}  // namespace

std::optional<LabelSlabResult> label_surfaces_in_slabs(const LabelSlabRequest& request,
                                                       const Settings& settings,
                                                       const SlabRunOptions& options, Team& team) {
  require_valid(settings);
  require_turns(options);
  const std::string slabs = options.slabs ? std::to_string(*options.slabs) : "of labels";
  const std::string description =
      description_of(settings) + " " + options.input + " slabs " + slabs;
  return run_in_scratch(options, description, team, [&](const Scratch& scratch) {
    return run_through(scratch, request, settings, options, team);
  });
}

}  // namespace mesamis::detail::slabs
