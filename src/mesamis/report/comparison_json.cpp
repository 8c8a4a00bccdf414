// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/comparison_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace mesamis::detail::report {
namespace {

using nlohmann::ordered_json;

ordered_json summary_json(const char* count_name, const DistanceSummary& s) {
  return {{count_name, s.count}, {"mean", s.mean}, {"rms", s.rms},
          {"p95", s.p95},        {"p99", s.p99},   {"max", s.max}};
}

ordered_json frame_json(const std::optional<Frame>& frame) {
  return frame ? ordered_json(frame_name(*frame)) : ordered_json(nullptr);
}

}  // namespace

ordered_json distances_json(const DirectedDistances& distances) {
  return distances_json(summarize(distances));
}

ordered_json distances_json(const DirectedSummary& summary) {
  ordered_json json = summary_json("vertices", summary.vertices);
  json["by_area"] = summary_json("samples", summary.area);
  return json;
}

ordered_json paper_distances_json(const DirectedDistances& reference_to_surface) {
  const std::vector<double>& local = reference_to_surface.from_vertices;
  const DistanceSummary s = summarize(local);
  return {{"hausdorff", s.max},
          {"average_hausdorff", s.mean},
          {"least_local", *std::min_element(local.begin(), local.end())}};
}

ordered_json objects_json(const std::vector<ObjectDistances>& objects) {
  ordered_json list = ordered_json::array();
  for (const ObjectDistances& object : objects) {
    ordered_json entry{{"name", object.name}};
    for (const DirectedDistances& d : object.directions) entry[d.name] = distances_json(d);
    list.push_back(std::move(entry));
  }
  return list;
}

ordered_json frames_json(const SurfacePair& pair) {
  ordered_json flip;
  if (pair.flip) {
    flip = {{"axes", to_string(pair.flip->flip)},
            {"mean_distance", pair.flip->distance_mm},
            {"mean_distance_flipped", pair.flip->flipped_distance_mm}};
  }
  return {{"reference", frame_json(pair.reference_frame)},
          {"surface", frame_json(pair.surface_frame)},
          {"surface_turned", pair.surface_turned},
          {"fits_better_flipped", flip}};
}

}  // namespace mesamis::detail::report
