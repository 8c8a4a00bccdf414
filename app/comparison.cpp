// SPDX-License-Identifier: Apache-2.0
#include "comparison.h"

#include <algorithm>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/surface/distance.h"

namespace mesamis {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kAreaSamples = 200000;
constexpr std::size_t kBins = 100;

ordered_json summary_json(const char* count_name, const std::vector<double>& distances) {
  const DistanceSummary s = summarize(distances);
  return {{count_name, s.count}, {"mean", s.mean}, {"rms", s.rms},
          {"p95", s.p95},        {"p99", s.p99},   {"max", s.max}};
}

std::vector<std::size_t> count_in_bins(const std::vector<double>& distances, double width) {
  std::vector<std::size_t> counts(kBins, 0);
  for (const double d : distances) {
    ++counts[std::min(static_cast<std::size_t>(d / width), kBins - 1)];
  }
  return counts;
}

double longest_of(std::span<const Direction> directions) {
  double longest = 0;
  for (const Direction& d : directions) {
    for (const auto* values : {&d.from_vertices, &d.from_area}) {
      for (const double value : *values) longest = std::max(longest, value);
    }
  }
  return longest;
}

void keep_inside(std::vector<Vec3>& points, const Box& box) {
  std::erase_if(points, [&box](const Vec3& p) { return !box.contains(p); });
}

}  // namespace

Direction measure(const std::string& name, const TriMesh& from, const TriMesh& to,
                  const std::optional<Box>& part) {
  std::vector<Vec3> vertices = from.points, samples = sample_by_area(from, kAreaSamples);
  if (part) {
    keep_inside(vertices, *part);
    keep_inside(samples, *part);
    if (vertices.empty() || samples.empty()) {
      throw InputError(name + ": no point of the first lies inside the box");
    }
  }
  return {name, distances_to_surface(vertices, to), distances_to_surface(samples, to)};
}

ordered_json direction_json(const Direction& direction) {
  ordered_json json = summary_json("vertices", direction.from_vertices);
  json["by_area"] = summary_json("samples", direction.from_area);
  return json;
}

ordered_json paper_json(const Direction& reference_to_surface) {
  const std::vector<double>& local = reference_to_surface.from_vertices;
  const DistanceSummary s = summarize(local);
  return {{"hausdorff", s.max},
          {"average_hausdorff", s.mean},
          {"least_local", *std::min_element(local.begin(), local.end())}};
}

DistanceHistogram histogram_of(std::span<const Direction> directions) {
  DistanceHistogram histogram;
  const double longest = longest_of(directions);
  if (longest > 0) histogram.width = longest / kBins;
  for (const Direction& d : directions) {
    histogram.columns.push_back(
        {d.name + "_vertices", count_in_bins(d.from_vertices, histogram.width)});
    histogram.columns.push_back({d.name + "_area", count_in_bins(d.from_area, histogram.width)});
  }
  return histogram;
}

std::string to_csv(const DistanceHistogram& histogram) {
  std::ostringstream text;
  text << "from_mm,to_mm";
  for (const auto& column : histogram.columns) text << "," << column.name;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    text << "\n"
         << static_cast<double>(bin) * histogram.width << ","
         << static_cast<double>(bin + 1) * histogram.width;
    for (const auto& column : histogram.columns) text << "," << column.counts[bin];
  }
  text << "\n";
  return text.str();
}

}  // namespace mesamis
