// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/scan_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/image/spline_image.h"
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

/// How far a voxel is from the quadratic polynomial that fits the 3x3x3 around it best.
double deviation_at(const VolumeView& volume, const std::array<Index, 3>& voxel) {
  // Weights by the number of axes along which a neighbour is off the middle.
  constexpr std::array<double, 4> kWeights{7.0 / 27, 4.0 / 27, 1.0 / 27, -2.0 / 27};
  double fitted = 0;
  for (Index k = -1; k <= 1; ++k) {
    for (Index j = -1; j <= 1; ++j) {
      for (Index i = -1; i <= 1; ++i) {
        const Index axes = std::abs(i) + std::abs(j) + std::abs(k);
        fitted += kWeights[static_cast<std::size_t>(axes)] *
                  volume.at(voxel[0] + i, voxel[1] + j, voxel[2] + k);
      }
    }
  }
  return std::abs(volume.at(voxel[0], voxel[1], voxel[2]) - fitted);
}

/// Slopes along the normals, native units per voxel: of the points whose normal is nearly an axis,
/// for each axis, and of all points.
std::array<std::vector<double>, 4> slopes_by_axis(const VolumeView& volume,
                                                  const PointGroup& points) {
  constexpr double kAlongAxis = 0.85;
  const SplineImage spline = interpolating_spline(copy_volume(volume));
  std::array<std::vector<double>, 4> slopes;
  for (const SurfacePoint* point : points) {
    const Vec3 d = voxel_direction(volume, point->normal);
    const double slope =
        -dot(spline_at(spline, point->position).gradient, voxel_step(volume, point->normal));
    slopes[3].push_back(slope);
    for (int a = 0; a < 3; ++a) {
      if (std::abs(d[a]) > kAlongAxis) slopes[static_cast<std::size_t>(a)].push_back(slope);
    }
  }
  return slopes;
}

}  // namespace

double measure_noise(const VolumeView& volume, const VolumeView& guide,
                     const std::vector<SurfacePoint>& points, double level) {
  const double share = std::sqrt(20.0 / 27);  // of white noise, left by the fit
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
                                   const std::vector<SurfacePoint>& points) {
  constexpr double kMostOfMiddle = 1.5, kMostBlur = 2;
  const PointGroup usable = with_normals(points);
  std::array<double, 3> blur{};
  if (usable.size() < kFewestProfilePoints) return blur;
  const Profile profile = median_profile(volume, usable);
  const auto [least, most] = std::minmax_element(profile.begin(), profile.end());
  auto slopes = slopes_by_axis(volume, usable);
  for (std::size_t a = 0; a < 3; ++a) {
    const double slope = median(slopes[a].size() < kFewestOfAnAxis ? slopes[3] : slopes[a]);
    blur[a] = slope > 0 ? (*most - *least) / (std::sqrt(2 * std::numbers::pi) * slope) : kMostBlur;
  }
  // Surfaces across one axis may be no plain edges (a table, thin walls): its blur is bounded.
  std::array<double, 3> sorted = blur;
  std::sort(sorted.begin(), sorted.end());
  for (double& b : blur) b = std::min({b, kMostOfMiddle * sorted[1], kMostBlur});
  return blur;
}

}  // namespace mesamis
