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
#include "mesamis/restore/spread_voxels.h"

namespace mesamis::detail::restore {
namespace {

constexpr std::size_t kFewestPlaces = 10, kFewestOfAnAxis = 100;
constexpr std::array<double, 2> kBeside{-2.5, 2.5};  // voxels from the surface
constexpr double kMadToDeviation = 1.4826;           // of a normal distribution
constexpr std::size_t kLookedAt = 100'000;           // voxels, where there is no surface

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

/// The standard deviation of noise, from the places' deviation_at().
double noise_of(std::vector<double>& deviations) {
  const double share = std::sqrt(20.0 / 27);  // of white noise, left by the fit
  return kMadToDeviation * median(deviations) / share;
}

/// A voxel beside the surface, and the normal of the surface there.
struct Beside {
  std::array<Index, 3> voxel;
  Vec3 normal;
};

/// Voxels at a distance from the surface, voxels, outwards.
std::vector<Beside> voxels_beside(const VolumeView& guide, const std::vector<SurfacePoint>& points,
                                  double distance, double level) {
  std::vector<std::optional<Beside>> places(points.size());
  parallel_for(points.size(), [&](std::size_t n) {
    const SurfacePoint& point = points[n];
    if (norm(point.normal) == 0) return;
    const auto place = place_along_normal(guide, point, distance, level);
    const auto voxel = place ? voxel_at(guide, *place) : std::nullopt;
    if (voxel) places[n] = {*voxel, point.normal};
  });
  std::vector<Beside> found;
  for (const auto& place : places) {
    if (place) found.push_back(*place);
  }
  return found;
}

/// Median square of the differences to the voxel `apart` steps along an axis that runs beside the
/// surface; nothing if there are few.
std::optional<double> median_square(const VolumeView& volume, const std::vector<Beside>& places,
                                    std::size_t axis, Index apart) {
  constexpr double kAlongSurface = 0.4;
  std::vector<double> squares;
  for (const auto& [voxel, normal] : places) {
    std::array<Index, 3> other = voxel;
    other[axis] += apart;
    if (std::abs(normal[static_cast<int>(axis)]) > kAlongSurface) continue;
    if (other[axis] >= volume.size[axis]) continue;
    const double d = double{volume.at(voxel[0], voxel[1], voxel[2])} -
                     double{volume.at(other[0], other[1], other[2])};
    squares.push_back(d * d);
  }
  if (squares.size() < kFewestPlaces) return std::nullopt;
  return median(squares);
}

/// The first of the axes that share one blur, for each axis. Two of equal spacing beside a third
/// that differs are the plane of a scanner's slices.
std::array<std::size_t, 3> groups_of_axes(const Vec3& spacing) {
  const auto equal = [&](int a, int b) {
    return std::abs(spacing[a] - spacing[b]) < 0.01 * spacing[a];
  };
  if (equal(0, 1) && equal(1, 2)) return {0, 1, 2};
  const std::size_t of_y = equal(0, 1) ? 0 : 1;
  if (equal(0, 2)) return {0, of_y, 0};
  return {0, of_y, equal(1, 2) ? std::size_t{1} : std::size_t{2}};
}

/// The axis with the finest samples.
std::size_t finest_axis(const Vec3& spacing) {
  std::size_t finest = 0;
  for (const std::size_t a : {1UL, 2UL}) {
    if (spacing[static_cast<int>(a)] < spacing[static_cast<int>(finest)]) finest = a;
  }
  return finest;
}

/// Bounds the blur, voxels: surfaces across one axis may be no plain edges (a table, thin walls).
void bound_blur(const Vec3& spacing, std::array<double, 3>& blur) {
  constexpr double kMostOfMiddle = 1.5, kMostBlur = 2;
  std::array<double, 3> sorted = blur;
  std::sort(sorted.begin(), sorted.end());
  for (double& b : blur) b = std::min({b, kMostOfMiddle * sorted[1], kMostBlur});
  const std::size_t finest = finest_axis(spacing);
  for (std::size_t a = 0; a < 3; ++a) {
    const bool coarse = spacing[static_cast<int>(a)] > 1.01 * spacing[static_cast<int>(finest)];
    if (coarse) blur[a] = std::min(blur[a], blur[finest]);
  }
}

/// An edge of the object, seen along its normal.
struct Edge {
  double slope;                  ///< of the spline through the samples, native units per mm
  std::array<double, 3> shares;  ///< squares of the normal's components, summed by groups of axes
};

std::vector<Edge> edges_at(const VolumeView& volume, const PointGroup& points,
                           const std::array<std::size_t, 3>& groups) {
  const SplineImage spline = interpolating_spline(copy_volume(volume));
  std::vector<Edge> edges(points.size());
  parallel_for(points.size(), [&](std::size_t e) {
    const Vec3& n = points[e]->normal;
    Edge& edge = edges[e];
    edge.slope = -dot(spline_at(spline, points[e]->position).gradient, n);
    edge.shares = {};
    for (std::size_t a = 0; a < 3; ++a) {
      edge.shares[groups[a]] += n[static_cast<int>(a)] * n[static_cast<int>(a)];
    }
  });
  return edges;
}

/// The median slope of the edges across the axes of one group, native units per mm; nothing if few
/// edges follow them. An edge across n is blurred by the root of sum n_a^2 s_a^2 along the axes a:
/// what the other axes add to it is not subtracted.
std::optional<double> slope_of_group(const std::vector<Edge>& edges, std::size_t group) {
  for (const double least : {0.72, 0.5}) {  // within 32 degrees of the group; 45, if these are few
    std::vector<double> of_group;
    for (const Edge& edge : edges) {
      if (edge.shares[group] > least) of_group.push_back(edge.slope);
    }
    if (of_group.size() < kFewestOfAnAxis) continue;
    const double slope = median(of_group);
    if (slope > 0) return slope;
  }
  return std::nullopt;
}

/// Blur along each axis, mm, of a step of this height; zeros if none is known. Axes that few edges
/// follow are taken to be blurred as the others are in the mean, but not less than thick slices
/// are.
std::array<double, 3> blur_of_axes(const VolumeView& volume, const PointGroup& points,
                                   double height) {
  constexpr double kUsualOfSlices = 0.45;  // voxels: found in real scans; 0.29 is the least
  const auto groups = groups_of_axes(volume.spacing);
  const std::vector<Edge> edges = edges_at(volume, points, groups);
  std::array<double, 3> blur{};
  for (std::size_t a = 0; a < 3; ++a) {
    if (groups[a] < a) {
      blur[a] = blur[groups[a]];
    } else if (const auto slope = slope_of_group(edges, a)) {
      blur[a] = height / (std::sqrt(2 * std::numbers::pi) * *slope);
    }
  }
  const auto unknown = std::count(blur.begin(), blur.end(), 0.0);
  if (unknown == 3) return blur;
  const double mean = (blur[0] + blur[1] + blur[2]) / static_cast<double>(3 - unknown);
  for (int a = 0; a < 3; ++a) {
    double& b = blur[static_cast<std::size_t>(a)];
    if (b == 0) b = std::max(mean, kUsualOfSlices * volume.spacing[a]);
  }
  return blur;
}

}  // namespace

double measure_noise(const VolumeView& volume, const VolumeView& guide,
                     const std::vector<SurfacePoint>& points, double level) {
  std::optional<double> quieter;
  for (const double distance : kBeside) {
    const std::vector<Beside> places = voxels_beside(guide, points, distance, level);
    std::vector<double> deviations(places.size());
    parallel_for(places.size(),
                 [&](std::size_t n) { deviations[n] = deviation_at(volume, places[n].voxel); });
    if (deviations.size() < kFewestPlaces) continue;
    const double deviation = noise_of(deviations);
    quieter = std::min(deviation, quieter.value_or(deviation));
  }
  return quieter.value_or(0);
}

double measure_noise(const VolumeView& volume) {
  std::vector<double> deviations;
  for (const auto& voxel : spread_voxels(volume, kLookedAt)) {
    deviations.push_back(deviation_at(volume, voxel));
  }
  return deviations.empty() ? 0 : noise_of(deviations);
}

std::array<double, 3> measure_noise_correlation(const VolumeView& volume, const VolumeView& guide,
                                                const std::vector<SurfacePoint>& points,
                                                double level) {
  std::array<double, 3> correlation{}, quietest{};
  for (const double distance : kBeside) {
    const auto places = voxels_beside(guide, points, distance, level);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto near = median_square(volume, places, a, 1),
                 far = median_square(volume, places, a, 2);
      if (!near || !far || !(*far > 0)) continue;
      if (quietest[a] > 0 && *far > quietest[a]) continue;
      quietest[a] = *far;
      correlation[a] = std::max(-1.0, 1 - *near / *far);
    }
  }
  return correlation;
}

std::array<double, 3> measure_blur(const VolumeView& volume,
                                   const std::vector<SurfacePoint>& points) {
  const double partial_volume = 1 / std::sqrt(12.0);  // of a voxel
  const PointGroup usable = with_normals(points);
  std::array<double, 3> blur{};
  if (usable.size() < kFewestProfilePoints) return blur;
  const Profile profile = median_profile(volume, usable);
  const auto [least, most] = std::minmax_element(profile.begin(), profile.end());
  const std::array<double, 3> mm = blur_of_axes(volume, usable, *most - *least);
  if (mm == std::array<double, 3>{}) return blur;
  for (std::size_t a = 0; a < 3; ++a) {
    blur[a] = std::max(mm[a] / volume.spacing[static_cast<int>(a)], partial_volume);
  }
  bound_blur(volume.spacing, blur);
  return blur;
}

}  // namespace mesamis::detail::restore
