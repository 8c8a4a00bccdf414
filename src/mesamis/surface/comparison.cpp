// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/comparison.h"

#include <algorithm>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/sampling.h"

namespace mesamis::detail::surface {
namespace {

constexpr std::size_t kAreaSamples = 200000;
constexpr std::size_t kBins = 100;

std::vector<std::size_t> count_in_bins(const std::vector<double>& distances, double width) {
  std::vector<std::size_t> counts(kBins, 0);
  for (const double d : distances) {
    ++counts[std::min(static_cast<std::size_t>(d / width), kBins - 1)];
  }
  return counts;
}

double longest_of(std::span<const DirectedDistances> directions) {
  double longest = 0;
  for (const DirectedDistances& d : directions) {
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

std::optional<DirectedDistances> find_distances(const std::string& name, const TriMesh& from,
                                                const TriMesh& to, const std::optional<Box>& part) {
  std::vector<Vec3> vertices = from.points, samples = sample_by_area(from, kAreaSamples);
  if (part) {
    keep_inside(vertices, *part);
    keep_inside(samples, *part);
    if (vertices.empty() || samples.empty()) return std::nullopt;
  }
  return DirectedDistances{name, distances_to_surface(vertices, to),
                           distances_to_surface(samples, to)};
}

DirectedDistances measure_distances(const std::string& name, const TriMesh& from, const TriMesh& to,
                                    const std::optional<Box>& part) {
  std::optional<DirectedDistances> found = find_distances(name, from, to, part);
  if (!found) throw InputError(name + ": no point of the first lies inside the box");
  return *std::move(found);
}

DirectedSummary summarize(const DirectedDistances& distances) {
  return {mesamis::summarize(distances.from_vertices), mesamis::summarize(distances.from_area)};
}

DistanceHistogram histogram_of(std::span<const DirectedDistances> directions) {
  DistanceHistogram histogram;
  const double longest = longest_of(directions);
  if (longest > 0) histogram.width = longest / kBins;
  for (const DirectedDistances& d : directions) {
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

}  // namespace mesamis::detail::surface
