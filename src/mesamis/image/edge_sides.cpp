// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/edge_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/scan_quality.h"

namespace mesamis {
namespace {

constexpr double kBoneHu = 200;
constexpr std::size_t kFewPoints = 10;
constexpr int kRounds = 10;
constexpr double kSettled = 0.005;  // change of the level, against the contrast
constexpr std::size_t kMostPoints = 200'000;

/// mm per voxel when walking along the unit direction d.
double voxel_step(const Volume& volume, const Vec3& d) {
  const Vec3& s = volume.spacing;
  return 1 / norm({d.x / s.x, d.y / s.y, d.z / s.z});
}

Vec3 gradient_at(const Volume& volume, Index i, Index j, Index k) {
  const std::array<Index, 3> at{i, j, k};
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    auto low = at, high = at;
    low[axis] = std::max(at[axis] - 1, 0);
    high[axis] = std::min(at[axis] + 1, volume.size[axis] - 1);
    g[axis] = (volume.at(high[0], high[1], high[2]) - volume.at(low[0], low[1], low[2])) /
              ((high[axis] - low[axis]) * volume.spacing[axis]);
  }
  return g;
}

/// Calls visit(i, j, k, axis) where the line from voxel (i, j, k) to its next crosses the level.
template <class Visit>
void for_each_crossing(const Volume& volume, double level, Visit&& visit) {
  for (Index k = 0; k < volume.size[2]; ++k) {
    for (Index j = 0; j < volume.size[1]; ++j) {
      for (Index i = 0; i < volume.size[0]; ++i) {
        const bool here = volume.at(i, j, k) > level;
        if (i + 1 < volume.size[0] && (volume.at(i + 1, j, k) > level) != here) visit(i, j, k, 0);
        if (j + 1 < volume.size[1] && (volume.at(i, j + 1, k) > level) != here) visit(i, j, k, 1);
        if (k + 1 < volume.size[2] && (volume.at(i, j, k + 1) > level) != here) visit(i, j, k, 2);
      }
    }
  }
}

/// How often the grid lines of each axis cross the level.
std::array<std::size_t, 3> count_crossings(const Volume& volume, double level) {
  std::array<std::size_t, 3> count{};
  for_each_crossing(volume, level, [&count](Index, Index, Index, int axis) {
    ++count[static_cast<std::size_t>(axis)];
  });
  return count;
}

/// The area of the level's surface, mm^2, from its crossings with the grid lines (Cauchy): along
/// an axis, each stands for so much area seen from there, and a surface whose normals point
/// everywhere is seen from the three axes at one and a half times its area.
double area_of(const Volume& volume, double level) {
  const auto count = count_crossings(volume, level);
  const Vec3& s = volume.spacing;
  return (static_cast<double>(count[0]) * s.y * s.z + static_cast<double>(count[1]) * s.x * s.z +
          static_cast<double>(count[2]) * s.x * s.y) /
         1.5;
}

SurfacePoint crossing(const Volume& volume, double level, std::array<Index, 3> at, int axis) {
  auto next = at;
  ++next[axis];
  const double a = volume.at(at[0], at[1], at[2]), b = volume.at(next[0], next[1], next[2]);
  const double t = std::clamp((level - a) / (b - a), 0.0, 1.0);
  SurfacePoint point;
  for (int c = 0; c < 3; ++c) point.position[c] = at[c] * volume.spacing[c];
  point.position[axis] += t * volume.spacing[axis];
  const Vec3 g = (1 - t) * gradient_at(volume, at[0], at[1], at[2]) +
                 t * gradient_at(volume, next[0], next[1], next[2]);
  const double length = norm(g);
  if (length > 0) point.normal = (-1 / length) * g;
  return point;
}

/// Where the tissue around `value` ends upwards: counts right of its peak down to a tenth.
double upper_end_of_tissue(const Volume& volume, double value, double level) {
  constexpr int kBins = 64;
  const double width = (level - value) / (kBins / 2.0);  // the level lies in the last bin
  std::vector<double> counts(kBins, 0);
  for (const float sample : volume.samples) {
    const double bin = (sample - value) / width + kBins / 2.0;
    if (bin >= 0 && bin < kBins) ++counts[static_cast<std::size_t>(bin)];
  }
  auto bin = static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  const double tenth = counts[static_cast<std::size_t>(bin)] / 10;
  while (bin + 1 < kBins && counts[static_cast<std::size_t>(bin)] > tenth) ++bin;
  return value + (bin - kBins / 2.0) * width;
}

/// Otsu's threshold of the voxels on edges alone: where most of the image is one tissue, the
/// threshold of all splits that tissue's noise.
/// @param calm  smoothed until edges stand out.
double level_of_edges(const Volume& calm) {
  constexpr double kOfMedian = 4;  // a gradient of noise is hardly ever that large
  std::vector<double> gradients(calm.voxel_count());
  const auto layer =
      static_cast<std::size_t>(calm.size[0]) * static_cast<std::size_t>(calm.size[1]);
  parallel_for_each(static_cast<std::size_t>(calm.size[2]), [&](std::size_t k) {
    for (std::size_t n = 0; n < layer; ++n) {
      const auto i = static_cast<Index>(n % static_cast<std::size_t>(calm.size[0]));
      const auto j = static_cast<Index>(n / static_cast<std::size_t>(calm.size[0]));
      gradients[k * layer + n] = norm(gradient_at(calm, i, j, static_cast<Index>(k)));
    }
  });
  std::vector<double> sorted = gradients;
  const double least = kOfMedian * median(sorted);
  Volume edges;
  for (std::size_t n = 0; n < gradients.size(); ++n) {
    if (gradients[n] > least) edges.samples.push_back(calm.samples[n]);
  }
  if (edges.samples.empty()) edges.samples = calm.samples;
  return otsu_split(edges).threshold;
}

/// Moves a level midway between the sides of its surface until it settles.
ObjectEdges settle_level(const Volume& volume, const Volume& calm, double level) {
  ObjectEdges object;
  object.level = level;
  for (int round = 0; round < kRounds; ++round) {
    const auto points = crossing_points(calm, object.level, kMostPoints);
    const auto sides = measure_sides(volume, calm, points, object.level);
    if (!sides) break;
    const double change = std::abs(sides->middle() - object.level);
    object.sides = *sides;
    object.level = sides->middle();
    if (change < kSettled * sides->contrast()) break;
  }
  return object;
}

/// Whether the two sides differ by more than the noise alone would make them.
bool stands_out(const ObjectEdges& object, const Volume& volume, const Volume& calm) {
  constexpr double kOfNoise = 2.5;
  const auto points = crossing_points(calm, object.level, kMostPoints);
  return object.sides.contrast() > kOfNoise * measure_noise(volume, calm, points, object.level);
}

ObjectEdges find_anywhere(const Volume& volume, const Volume& calm) {
  const bool bone = is_hounsfield(volume) && quantiles(volume, {0.999})[0] > kBoneHu;
  if (bone) return settle_level(volume, calm, kBoneHu);
  const ObjectEdges object = settle_level(volume, calm, otsu_split(volume).threshold);
  if (stands_out(object, volume, calm)) return object;
  return settle_level(volume, calm, level_of_edges(smoothed(calm)));
}

}  // namespace

std::optional<Vec3> place_beside(const Volume& guide, const SurfacePoint& point, double voxels,
                                 double level) {
  const double step = std::copysign(voxel_step(guide, point.normal), voxels);
  const Box box = guide.box();
  Vec3 p;
  for (const double gone : {0.75, 1.5, 2.5}) {
    if (gone > std::abs(voxels)) break;
    p = point.position + gone * step * point.normal;
    if (!box.contains(p) || (interpolate(guide, p) > level) != (voxels < 0)) return std::nullopt;
  }
  return p;
}

std::optional<EdgeSides> measure_sides(const Volume& volume, const Volume& guide,
                                       const std::vector<SurfacePoint>& points, double level) {
  constexpr double kOff = 1.5;  // voxels
  std::vector<double> inside, outside;
  for (const SurfacePoint& point : points) {
    if (norm(point.normal) == 0) continue;
    if (const auto place = place_beside(guide, point, -kOff, level)) {
      inside.push_back(interpolate(volume, *place));
    }
    if (const auto place = place_beside(guide, point, kOff, level)) {
      outside.push_back(interpolate(volume, *place));
    }
  }
  if (inside.size() < kFewPoints || outside.size() < kFewPoints) return std::nullopt;
  EdgeSides sides;
  sides.inside = median(inside);
  sides.outside = median(outside);
  sides.samples = inside.size() + outside.size();
  return sides;
}

std::vector<SurfacePoint> crossing_points(const Volume& volume, double level, std::size_t most) {
  const auto count = count_crossings(volume, level);
  const std::size_t every =
      std::max<std::size_t>(1, (count[0] + count[1] + count[2]) / std::max<std::size_t>(1, most));
  std::vector<SurfacePoint> points;
  std::size_t n = 0;
  for_each_crossing(volume, level, [&](Index i, Index j, Index k, int axis) {
    if (n++ % every == 0) points.push_back(crossing(volume, level, {i, j, k}, axis));
  });
  return points;
}

ObjectEdges find_object(const Volume& volume, const FindObjectOptions& options) {
  const Volume calm = smoothed(volume);
  ObjectEdges object =
      options.start ? settle_level(volume, calm, *options.start) : find_anywhere(volume, calm);
  object.area = area_of(calm, options.area_at.value_or(object.level));
  return object;
}

double find_threshold(const Volume& volume, const EdgeSides& sides, double level, double noise) {
  constexpr double kClearOfNoise = 2.5;
  constexpr double kTwoClasses = 4;    // one class's halves are 1.6 times its noise apart
  constexpr double kThirdClass = 0.5;  // distance of the two dark classes, against the contrast
  if (!(sides.contrast() > 0)) return std::numeric_limits<double>::lowest();
  const OtsuSplit dark = otsu_split(volume, level);
  const double apart = dark.mean_above - dark.mean_below;
  if (apart < std::max(kThirdClass * sides.contrast(), kTwoClasses * noise)) {
    return std::numeric_limits<double>::lowest();
  }
  return std::min({upper_end_of_tissue(volume, sides.outside, level),
                   sides.outside + 0.5 * (level - sides.outside), level - kClearOfNoise * noise});
}

}  // namespace mesamis
