// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/scan_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/restore/edge_profile.h"
#include "mesamis/restore/object_contrast.h"

namespace mesamis {
namespace {

constexpr std::size_t kFewestPlaces = 10, kFewestOfAnAxis = 100;
constexpr double kMadToDeviation = 1.4826;  // of a normal distribution

/// The voxel nearest to a place, or nothing within one voxel of the border.
std::optional<std::array<Index, 3>> voxel_at(const VoxelGrid& grid, const Vec3& p) {
  std::array<Index, 3> voxel;
  for (int a = 0; a < 3; ++a) {
    const double n = std::round(p[a] / grid.spacing[a]);
    if (!(n >= 1 && n <= grid.size[a] - 2)) return std::nullopt;
    voxel[a] = static_cast<Index>(n);
  }
  return voxel;
}

/// How far a voxel is from the mean of the 3x3x3 around it.
double deviation_at(const VolumeView& volume, const std::array<Index, 3>& voxel) {
  double sum = 0;
  for (Index k = -1; k <= 1; ++k) {
    for (Index j = -1; j <= 1; ++j) {
      for (Index i = -1; i <= 1; ++i) sum += volume.at(voxel[0] + i, voxel[1] + j, voxel[2] + k);
    }
  }
  return std::abs(volume.at(voxel[0], voxel[1], voxel[2]) - sum / 27);
}

/// Half a profile, from the surface to one side: its rise after each step, up to where it rises no
/// more (a thin wall ends).
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

/// The sharper of the two halves: the next tissue widens one of them. Where a half rises for two
/// voxels, shorter ones do not count: the far side of a wall cuts them off.
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

/// The blur of the image from that of the profile: less the variances of the interpolation and of
/// the scatter of the points.
double image_blur(const HalfEdge& edge, double noise) {
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

}  // namespace

double measure_noise(const VolumeView& volume, const VolumeView& guide,
                     const std::vector<SurfacePoint>& points, double level) {
  const double share =
      std::sqrt(26.0 / 27);  // left of white noise without its neighbourhood's mean
  std::optional<double> quieter;
  for (const double distance : {-2.5, 2.5}) {  // voxels
    std::vector<double> deviations;
    for (const SurfacePoint& point : points) {
      if (norm(point.normal) == 0) continue;
      const auto place = place_along_normal(guide, point, distance, level);
      const auto voxel = place ? voxel_at(volume, *place) : std::nullopt;
      if (voxel) deviations.push_back(deviation_at(volume, *voxel));
    }
    if (deviations.size() < kFewestPlaces) continue;
    const double deviation = kMadToDeviation * median(deviations) / share;
    quieter = std::min(deviation, quieter.value_or(deviation));
  }
  return quieter.value_or(0);
}

std::array<double, 3> measure_blur(const VolumeView& volume,
                                   const std::vector<SurfacePoint>& points, double noise) {
  constexpr double kAlongAxis = 0.9, kMostOfMiddle = 1.5, kMostBlur = 2;
  const PointGroup usable = with_normals(points);
  std::array<PointGroup, 3> along;
  for (const SurfacePoint* point : usable) {
    const Vec3 d = voxel_direction(volume, point->normal);
    for (int a = 0; a < 3; ++a) {
      if (std::abs(d[a]) > kAlongAxis) along[static_cast<std::size_t>(a)].push_back(point);
    }
  }
  std::array<double, 3> blur{};
  if (usable.size() < kFewestProfilePoints) return blur;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto& group = along[a].size() < kFewestOfAnAxis ? usable : along[a];
    blur[a] = image_blur(sharper_half(median_profile(volume, group)), noise);
  }
  // Surfaces across one axis may be no plain edges (a table, thin walls): its blur is bounded.
  std::array<double, 3> sorted = blur;
  std::sort(sorted.begin(), sorted.end());
  for (double& b : blur) b = std::min({b, kMostOfMiddle * sorted[1], kMostBlur});
  return blur;
}

}  // namespace mesamis
