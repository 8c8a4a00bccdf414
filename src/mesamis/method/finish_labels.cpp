// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/finish_labels.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "mesamis/base/stopwatch.h"
#include "mesamis/decimate/decimate_partition.h"
#include "mesamis/decimate/round_together.h"
#include "mesamis/decimate/simplify.h"
#include "mesamis/method/expected_error.h"
#include "mesamis/method/passes.h"
#include "mesamis/surface/select_parts.h"

namespace mesamis::detail::method {
namespace {

constexpr double kErrorOfLabels = 0.04;  // voxels of the labels, where they are right

void append(const PartitionSurface& partition, TriMesh& all) {
  const auto first = static_cast<Index>(all.points.size());
  all.points.insert(all.points.end(), partition.points.begin(), partition.points.end());
  for (const Triangle& t : partition.triangles) {
    all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

/// How exact the boundaries of all layers are expected to be in the mean, mm; 0 for a preview, of
/// which nothing depends on it.
/// @param input  of the image; nullptr: none, and the labels are right.
double mean_error_of(const LabelRun& run, const std::vector<LayerBoundaries>& layers,
                     const RunInput* input) {
  if (run.settings.preview) return 0;
  if (input == nullptr) return kErrorOfLabels * run.request.map.voxel_size();
  TriMesh all;
  for (const LayerBoundaries& layer : layers) append(layer.partition, all);
  return expected_shape_error(*input, all).mean;
}

/// Rounds and decimates what objects share in one.
/// @return how far decimation, with rounding, moved boundaries at most, mm.
double decimate(const LabelRun& run, const Parameters& p, PartitionSurface& partition) {
  const double tolerance = *p.tolerance;
  if (partition.triangles.empty()) return 0;
  if (tolerance > 0) run.begin("decimation");
  const double shift = round_in_place(partition.points);
  if (tolerance == 0) return 0;
  DecimateOptions options;
  options.tolerance = std::max(0.0, tolerance - shift);
  options.triangles = p.triangles;
  options.progress = run.progress;
  DecimateReport report;
  partition = run.settings.preview ? decimate_partition(partition, options, &report)
                                   : simplify_partition(partition, options, &report);
  return shift + std::max(report.original_to_result, report.result_to_original);
}

/// The parts that the settings leave; one at least, unless they give a volume.
TriMesh selected(const LabelRun& run, TriMesh surface) {
  const Settings& settings = run.settings;
  const PartSelection wanted{least_volume(run), settings.keep_largest, settings.fill_cavities,
                             !settings.min_volume};
  const bool all = wanted.volume_min == 0 && wanted.keep_largest == 0 && !wanted.fill_cavities;
  if (all || surface.triangles.empty()) return surface;
  return select_parts(surface, wanted);
}

/// Decimates the boundaries of a layer, and makes a surface for each of its objects.
void finish_layer(const LabelRun& run, LayerBoundaries layer, const RunInput* input,
                  LabelResult& result) {
  std::map<Index, std::int64_t> extracted;
  for (const auto& sides : layer.partition.sides) {
    for (const Index side : sides) ++extracted[side];
  }
  const double decimated = decimate(run, result.parameters, layer.partition);
  result.decimated = std::max(result.decimated, decimated);
  std::vector<Segment> segments;
  std::vector<Index> labels;
  for (const Segment& segment : run.chosen) {
    if (segment.layer != layer.layer) continue;
    segments.push_back(segment);
    labels.push_back(segment.label);
  }
  std::vector<TriMesh> surfaces = object_surfaces(layer.partition, labels);
  for (std::size_t n = 0; n < segments.size(); ++n) {
    LabelledObject object{
        segments[n], selected(run, std::move(surfaces[n])), {}, extracted[labels[n]]};
    if (object.surface.triangles.empty()) continue;
    if (input != nullptr && layer.placed[static_cast<std::size_t>(labels[n])] != 0) {
      ErrorOptions delivered = input->error;
      delivered.decimated = decimated;
      object.expected_error = expected_error(object.surface, input->image, delivered);
    }
    result.objects.push_back(std::move(object));
  }
}

}  // namespace

double least_volume(const LabelRun& run) {
  if (run.settings.min_volume) return *run.settings.min_volume;
  return run.settings.keep_topology ? 0 : run.request.map.voxel_volume();
}

void finish_layers(const LabelRun& run, std::vector<LayerBoundaries> layers, const RunInput* input,
                   LabelResult& result) {
  Stopwatch watch;
  const double voxel = input ? input->grey.voxel_size() : run.request.map.voxel_size();
  choose_tolerance(result.parameters, voxel, mean_error_of(run, layers, input),
                   run.settings.preview ? kErrorsOfPreview : kErrorsOfLabels);
  for (LayerBoundaries& layer : layers) {
    result.flow_converged &= layer.converged;
    result.boundaries.insert(result.boundaries.end(), layer.boundaries.begin(),
                             layer.boundaries.end());
    finish_layer(run, std::move(layer), input, result);
  }
  result.seconds.printable = watch.lap();
}

}  // namespace mesamis::detail::method
