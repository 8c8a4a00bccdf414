// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/pair_levels.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/each_once.h"
#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/normals.h"

namespace mesamis::detail::labels {
namespace {

constexpr std::array kDepths{0.75, 1.25, 1.75, 2.25, 3.0};  // voxels from the boundary
constexpr Index kSeveral = -2;                              // pairs at one point

/// The plateaus on both sides of a point of the boundary.
struct Plateaus {
  double first = 0, second = 0;
};

/// The pairs of sides that occur, increasing.
std::vector<PairLevel> pairs_in(const PartitionSurface& partition) {
  std::vector<std::array<Index, 2>> sides = partition.sides;
  sort_once(sides);
  std::vector<PairLevel> pairs;
  for (const auto& pair : sides) {
    if (pair[0] != kNoIndex && pair[1] != kNoIndex) pairs.push_back({.sides = pair});
  }
  return pairs;
}

/// Whether the first side is the brighter one where the image rises and falls most.
bool first_is_brighter(std::vector<double> slopes) { return median(slopes) > 0; }

/// @param outward  unit, from the first side to the second.
Plateaus plateaus_at(const SplineImage& image, const Vec3& p, const Vec3& outward,
                     bool first_brighter) {
  const double voxel = image.grid.voxel_size();
  const auto bounded = [&](double depth) {
    return std::clamp<double>(spline_value_at(image, p + (depth * voxel) * outward), image.low,
                              image.high);
  };
  const auto extreme = [&](double sign, bool largest) {
    double best = bounded(sign * kDepths.front());
    for (const double depth : kDepths) {
      const double value = bounded(sign * depth);
      best = largest ? std::max(best, value) : std::min(best, value);
    }
    return best;
  };
  return {extreme(-1, first_brighter), extreme(1, !first_brighter)};
}

void measure(const PartitionSurface& partition, const SplineImage& image,
             const std::vector<Vec3>& normals, const std::vector<Index>& points, PairLevel& pair) {
  if (points.empty()) return;
  std::vector<double> slopes(points.size()), first(points.size()), second(points.size());
  parallel_for(points.size(), [&](std::size_t n) {
    const Index p = points[n];
    slopes[n] = -dot(spline_at(image, partition.points[p]).gradient, normals[p]);
  });
  const bool brighter = first_is_brighter(slopes);
  parallel_for(points.size(), [&](std::size_t n) {
    const Plateaus seen =
        plateaus_at(image, partition.points[points[n]], normals[points[n]], brighter);
    first[n] = seen.first;
    second[n] = seen.second;
  });
  const double a = median(first), b = median(second);
  pair = {pair.sides, (a + b) / 2, a - b, points.size()};
}

}  // namespace

std::vector<Index> pairs_of_points(const PartitionSurface& partition,
                                   const std::vector<PairLevel>& pairs) {
  std::vector<Index> pair_of(partition.points.size(), kNoIndex);
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    const auto at = std::lower_bound(pairs.begin(), pairs.end(), partition.sides[t],
                                     [](const PairLevel& pair, const std::array<Index, 2>& sides) {
                                       return pair.sides < sides;
                                     });
    const bool known = at != pairs.end() && at->sides == partition.sides[t];
    const Index pair = known ? static_cast<Index>(at - pairs.begin()) : kSeveral;
    for (const Index p : partition.triangles[t]) {
      pair_of[p] = pair_of[p] == kNoIndex || pair_of[p] == pair ? pair : kSeveral;
    }
  }
  std::replace(pair_of.begin(), pair_of.end(), kSeveral, kNoIndex);
  return pair_of;
}

std::vector<PairLevel> measure_pair_levels(const PartitionSurface& partition,
                                           const SplineImage& image) {
  std::vector<PairLevel> pairs = pairs_in(partition);
  const std::vector<Vec3> normals = vertex_normals({partition.points, partition.triangles});
  const std::vector<Index> pair_of = pairs_of_points(partition, pairs);
  std::vector<std::vector<Index>> points(pairs.size());
  for (std::size_t p = 0; p < pair_of.size(); ++p) {
    if (pair_of[p] != kNoIndex) points[pair_of[p]].push_back(static_cast<Index>(p));
  }
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    measure(partition, image, normals, points[n], pairs[n]);
  }
  return pairs;
}

}  // namespace mesamis::detail::labels
