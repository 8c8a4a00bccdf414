// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/scan_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/image/edge_profile.h"

namespace mesamis {
namespace {

constexpr std::size_t kFewPlaces = 10, kFewProfiles = 100, kFewOfAnAxis = 100;
constexpr double kMadToDeviation = 1.4826;  // of a normal distribution

/// The voxel next to a place, or nothing within one voxel of the border.
std::optional<std::array<Index, 3>> voxel_at(const Volume& volume, const Vec3& p) {
  std::array<Index, 3> voxel;
  for (int a = 0; a < 3; ++a) {
    const double n = std::round(p[a] / volume.spacing[a]);
    if (!(n >= 1 && n <= volume.size[a] - 2)) return std::nullopt;
    voxel[a] = static_cast<Index>(n);
  }
  return voxel;
}

/// How far a voxel is from the mean of the 3x3x3 around it.
double deviation_at(const Volume& volume, const std::array<Index, 3>& voxel) {
  double sum = 0;
  for (Index k = -1; k <= 1; ++k) {
    for (Index j = -1; j <= 1; ++j) {
      for (Index i = -1; i <= 1; ++i) sum += volume.at(voxel[0] + i, voxel[1] + j, voxel[2] + k);
    }
  }
  return std::abs(volume.at(voxel[0], voxel[1], voxel[2]) - sum / 27);
}

// The edge's profile.

/// Those that have a normal.
PointGroup with_normals(const std::vector<SurfacePoint>& points) {
  PointGroup group;
  for (const SurfacePoint& point : points) {
    if (norm(point.normal) > 0) group.push_back(&point);
  }
  return group;
}

/// Half a profile, from the surface to one side: by how much it has risen after each step, up to
/// where it rises no more (a thin wall ends).
std::vector<double> rise(const Profile& profile, int direction) {
  std::vector<double> heights;
  double highest = 0;
  for (int n = 1; n <= kProfileHalf; ++n) {
    const auto at = static_cast<std::size_t>(std::ptrdiff_t{kProfileHalf} + direction * n);
    const double height = direction * (profile[at] - profile[kProfileHalf]);
    if (height < highest) break;
    heights.push_back(highest = height);
  }
  return heights;
}

/// A Gaussian edge of one side: of deviation sigma, voxels, and height h it is h erf(t / sqrt(2)
/// sigma) after t voxels.
struct HalfEdge {
  double sigma = 0, height = 0;
};
HalfEdge fit_half(const std::vector<double>& heights) {
  constexpr double kNarrowest = 0.2, kWidest = 3.5, kStep = 0.01;
  HalfEdge best;
  double least = std::numeric_limits<double>::infinity();
  for (double sigma = kNarrowest; sigma <= kWidest; sigma += kStep) {
    double ee = 0, eh = 0, hh = 0;
    for (std::size_t n = 0; n < heights.size(); ++n) {
      const double t = static_cast<double>(n + 1) * kProfileStep;
      const double e = std::erf(t / (std::sqrt(2) * sigma));
      ee += e * e, eh += e * heights[n], hh += heights[n] * heights[n];
    }
    const double misfit = hh - eh * eh / ee;
    if (misfit < least) {
      least = misfit;
      best = {sigma, 2 * eh / ee};
    }
  }
  return best;
}

/// The sharper of the two sides, for what comes after the edge (the next tissue) widens one of
/// them; of those that rise for two voxels, if there are any, for the far side of a wall cuts one
/// short.
HalfEdge sharper_half(const Profile& profile) {
  constexpr std::size_t kWhole = 8, kFewest = 4;  // samples: two voxels, one
  const std::array<std::vector<double>, 2> sides{rise(profile, -1), rise(profile, 1)};
  const std::size_t longest = std::max(sides[0].size(), sides[1].size());
  HalfEdge best;
  for (const auto& heights : sides) {
    if (heights.size() < (longest < kWhole ? kFewest : kWhole)) continue;
    const HalfEdge edge = fit_half(heights);
    if (best.sigma == 0 || edge.sigma < best.sigma) best = edge;
  }
  return best;
}

/// The blur of the image from that of the profile.
double blur_behind(const HalfEdge& edge, double noise) {
  constexpr double kInterpolation = 1.0 / 6;  // variance of the hat function
  constexpr double kGuideBlur = 1;            // variance of smoothed(smoothed()), per axis
  const double kGuideNoise = std::pow(70.0 / 256, 1.5);  // white noise it leaves
  if (!(edge.height > 0)) return 0;
  const double square = edge.sigma * edge.sigma - kInterpolation;
  const double slope =
      edge.height / std::sqrt(2 * std::numbers::pi * (std::max(square, 0.0) + kGuideBlur));
  const double scatter = kGuideNoise * noise / slope;
  return std::sqrt(std::max(0.0, square - scatter * scatter));
}

// Impulses.

/// Calls visit(value) for the 26 voxels around, cut off at the border, until it says stop (true).
template <class Visit>
void visit_neighbors(const Volume& volume, const std::array<Index, 3>& voxel, Visit&& visit) {
  std::array<Index, 3> low, high;
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = std::max(voxel[a] - 1, 0);
    high[a] = std::min(voxel[a] + 1, volume.size[a] - 1);
  }
  for (Index k = low[2]; k <= high[2]; ++k) {
    for (Index j = low[1]; j <= high[1]; ++j) {
      for (Index i = low[0]; i <= high[0]; ++i) {
        const bool is_itself = i == voxel[0] && j == voxel[1] && k == voxel[2];
        if (!is_itself && visit(volume.at(i, j, k))) return;
      }
    }
  }
}

bool is_impulse(const Volume& volume, const std::array<Index, 3>& voxel, float difference) {
  const float value = volume.at(voxel[0], voxel[1], voxel[2]);
  int alike = 0;
  visit_neighbors(volume, voxel, [&](float other) {
    alike += std::abs(other - value) <= difference;
    return alike == 2;
  });
  return alike < 2;
}

float median_around(const Volume& volume, const std::array<Index, 3>& voxel) {
  std::vector<double> values;
  visit_neighbors(volume, voxel, [&values](float value) {
    values.push_back(value);
    return false;
  });
  return static_cast<float>(median(values));
}

}  // namespace

double measure_noise(const Volume& volume, const Volume& guide,
                     const std::vector<SurfacePoint>& points, double level) {
  const double seen = std::sqrt(26.0 / 27);  // of white noise, its neighbourhood's mean taken off
  std::optional<double> quieter;
  for (const double off : {-2.5, 2.5}) {  // voxels
    std::vector<double> deviations;
    for (const SurfacePoint& point : points) {
      if (norm(point.normal) == 0) continue;
      const auto place = place_beside(guide, point, off, level);
      const auto voxel = place ? voxel_at(volume, *place) : std::nullopt;
      if (voxel) deviations.push_back(deviation_at(volume, *voxel));
    }
    if (deviations.size() < kFewPlaces) continue;
    const double deviation = kMadToDeviation * median(deviations) / seen;
    quieter = std::min(deviation, quieter.value_or(deviation));
  }
  return quieter.value_or(0);
}

std::array<double, 3> measure_blur(const Volume& volume, const std::vector<SurfacePoint>& points,
                                   double noise) {
  constexpr double kAlongAxis = 0.9, kMostOfMiddle = 1.5, kMostBlur = 2;
  const PointGroup all = with_normals(points);
  std::array<PointGroup, 3> along;
  for (const SurfacePoint* point : all) {
    const Vec3 d = voxel_direction(volume, point->normal);
    for (int a = 0; a < 3; ++a) {
      if (std::abs(d[a]) > kAlongAxis) along[static_cast<std::size_t>(a)].push_back(point);
    }
  }
  std::array<double, 3> blur{};
  if (all.size() < kFewProfiles) return blur;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto& group = along[a].size() < kFewOfAnAxis ? all : along[a];
    blur[a] = blur_behind(sharper_half(median_profile(volume, group)), noise);
  }
  // One axis whose surfaces are no plain edges (a table, thin walls) must not be overdone.
  std::array<double, 3> sorted = blur;
  std::sort(sorted.begin(), sorted.end());
  for (double& b : blur) b = std::min({b, kMostOfMiddle * sorted[1], kMostBlur});
  return blur;
}

std::optional<double> measure_level(const Volume& volume, const std::vector<SurfacePoint>& points) {
  const PointGroup all = with_normals(points);
  if (all.size() < kFewProfiles) return std::nullopt;
  constexpr double kMostMisfit = 0.01;
  const Edge edge = fit_edge(median_profile(volume, all));
  if (!(edge.misfit < kMostMisfit * edge.height())) return std::nullopt;
  return edge.level();
}

std::size_t remove_impulses(Volume& volume, double difference, double least_share) {
  const auto layers = static_cast<std::size_t>(volume.size[2]);
  std::vector<std::vector<std::pair<std::size_t, float>>> found(layers);
  parallel_for_each(layers, [&](std::size_t layer) {
    const auto k = static_cast<Index>(layer);
    for (Index j = 0; j < volume.size[1]; ++j) {
      for (Index i = 0; i < volume.size[0]; ++i) {
        if (is_impulse(volume, {i, j, k}, static_cast<float>(difference))) {
          found[layer].emplace_back(volume.offset(i, j, k), median_around(volume, {i, j, k}));
        }
      }
    }
  });
  std::size_t count = 0;
  for (const auto& layer : found) count += layer.size();
  if (static_cast<double>(count) / static_cast<double>(volume.voxel_count()) < least_share)
    return 0;
  for (const auto& layer : found) {
    for (const auto& [voxel, value] : layer) volume.samples[voxel] = value;
  }
  return count;
}

}  // namespace mesamis
