// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/restore.h"

#include <algorithm>
#include <utility>

#include "mesamis/image/deblur.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/scan_quality.h"

namespace mesamis {
namespace {

constexpr std::size_t kMostPoints = 100'000;
/// Regularization per noise against contrast: found on phantoms, where half and twice as much
/// cost a tenth of the distance.
/// Divided by the blur's mean square, for the filter's own unit of frequency is the blur, which the
/// noise does not share.
constexpr double kRegularization = 0.2, kLeastRegularization = 0.004, kMostRegularization = 1;
/// An impulse stands out from the noise and against the contrast.
constexpr double kImpulseOfNoise = 5, kImpulseOfContrast = 0.25;
/// Fewer impulses than this are not a fault of the scan but something small.
constexpr double kFewImpulses = 1e-3;
/// What is sharper than this has nothing to undo but the voxels' own extent.
constexpr double kSharp = 0.3;

double mean_square(const std::array<double, 3>& x) {
  return (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / 3;
}

/// The share of the voxels that were replaced.
double take_impulses(Volume& volume, double noise, double contrast) {
  const double difference = std::max(kImpulseOfNoise * noise, kImpulseOfContrast * contrast);
  const std::size_t count = remove_impulses(volume, difference, kFewImpulses);
  return static_cast<double>(count) / static_cast<double>(volume.voxel_count());
}

}  // namespace

Restored restore(Volume volume, const ObjectEdges& object, const RestoreOptions& options) {
  Restored restored{std::move(volume), options.noise.value_or(0), 0,
                    options.blur.value_or(std::array<double, 3>{}), 0};
  const double contrast = object.sides.contrast();
  if (!(contrast > 0)) return restored;
  Volume guide;
  std::vector<SurfacePoint> points;
  const auto look = [&] {
    guide = smoothed(restored.volume);
    points = crossing_points(guide, object.level, kMostPoints);
    if (options.noise) return;
    restored.noise = measure_noise(restored.volume, guide, points, object.level);
  };
  look();
  restored.impulses = take_impulses(restored.volume, restored.noise, contrast);
  if (restored.impulses > 0) look();
  if (!options.blur) {
    const auto calm_points = crossing_points(smoothed(guide), object.level, kMostPoints);
    restored.blur = measure_blur(restored.volume, calm_points, restored.noise);
  }
  if (*std::max_element(restored.blur.begin(), restored.blur.end()) > kSharp) {
    const double r = std::clamp(kRegularization * restored.noise / contrast, kLeastRegularization,
                                kMostRegularization) /
                     mean_square(restored.blur);
    restored.volume = deblurred(restored.volume, restored.blur, r);
  }
  restored.noise_left = measure_noise(restored.volume, guide, points, object.level);
  return restored;
}

}  // namespace mesamis
