// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/value_variation.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/restore/edge_profile.h"

namespace mesamis::detail::restore {
namespace {

constexpr double kStep = 0.25;        // voxels
constexpr double kDeepest = 2.5;      // voxels
constexpr double kQuartiles = 1.349;  // their distance, in standard deviations of a Gaussian

/// The greatest value below a point, native units.
double peak_below(const VolumeView& volume, const SurfacePoint& point) {
  const Vec3 voxel = voxel_step(volume, point.normal);
  const Box box = volume.box();
  double peak = interpolate(volume, point.position);
  for (double depth = kStep; depth <= kDeepest; depth += kStep) {
    const Vec3 p = point.position - depth * voxel;
    if (!box.contains(p)) break;
    peak = std::max(peak, interpolate(volume, p));
  }
  return peak;
}

}  // namespace

double measure_variation(const VolumeView& volume, const std::vector<SurfacePoint>& points,
                         double noise) {
  const PointGroup usable = with_normals(points);
  if (usable.size() < kFewestProfilePoints) return 0;
  std::vector<double> peaks(usable.size());
  parallel_for(peaks.size(), [&](std::size_t n) { peaks[n] = peak_below(volume, *usable[n]); });
  const auto quartile = [&peaks](std::size_t q) {
    const auto at = peaks.begin() + static_cast<std::ptrdiff_t>(q * (peaks.size() - 1) / 4);
    std::nth_element(peaks.begin(), at, peaks.end());
    return *at;
  };
  const double spread = (quartile(3) - quartile(1)) / kQuartiles;
  return std::sqrt(std::max(0.0, spread * spread - noise * noise));
}

}  // namespace mesamis::detail::restore
