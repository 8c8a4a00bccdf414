// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/half_maximum_level.h"

#include <cmath>
#include <vector>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/restore/scan_quality.h"

namespace mesamis {
namespace {

constexpr double kBoneHu = 200;
constexpr int kMostIterations = 10;
constexpr double kTolerance = 0.005;  // change of the level, against the contrast
constexpr std::size_t kMostPoints = 200'000;

/// The norm of the gradient at every voxel.
std::vector<double> gradient_norms(const VolumeView& volume) {
  std::vector<double> norms(volume.voxel_count());
  const auto nx = static_cast<std::size_t>(volume.size[0]);
  const std::size_t layer = nx * static_cast<std::size_t>(volume.size[1]);
  parallel_for_each(static_cast<std::size_t>(volume.size[2]), [&](std::size_t k) {
    for (std::size_t n = 0; n < layer; ++n) {
      const auto i = static_cast<Index>(n % nx), j = static_cast<Index>(n / nx);
      norms[k * layer + n] = norm(gradient_at(volume, i, j, static_cast<Index>(k)));
    }
  });
  return norms;
}

/// Otsu's threshold of the voxels on edges: where most of the image is one tissue, the threshold of
/// all voxels splits that tissue's noise.
/// @param smooth  smoothed until edges exceed the noise.
double otsu_threshold_on_edges(const VolumeView& smooth) {
  constexpr double kOfMedian = 4;  // a gradient of noise is hardly ever that large
  const std::vector<double> gradients = gradient_norms(smooth);
  std::vector<double> sorted = gradients;
  const double least = kOfMedian * median(sorted);
  std::vector<float> on_edges;
  for (std::size_t n = 0; n < gradients.size(); ++n) {
    if (gradients[n] > least) on_edges.push_back(smooth.samples[n]);
  }
  return otsu_split(on_edges.empty() ? smooth : VolumeView{{}, on_edges}).threshold;
}

/// The fixed-point iteration from a level.
/// @param guide  the volume, smoothed.
HalfMaximumLevel iterate_from(double level, const VolumeView& volume, const VolumeView& guide) {
  HalfMaximumLevel object;
  object.level = level;
  for (int n = 0; n < kMostIterations; ++n) {
    const auto points = crossing_points(guide, object.level, kMostPoints);
    const auto contrast = measure_contrast(volume, guide, points, object.level);
    if (!contrast) break;
    const double change = std::abs(contrast->half_maximum() - object.level);
    object.contrast = *contrast;
    object.level = contrast->half_maximum();
    if (change < kTolerance * contrast->difference()) break;
  }
  return object;
}

/// Whether the contrast exceeds so many deviations of the noise.
bool exceeds_noise(const HalfMaximumLevel& object, double deviations, const VolumeView& volume,
                   const VolumeView& guide) {
  const auto points = crossing_points(guide, object.level, kMostPoints);
  return object.contrast.difference() >
         deviations * measure_noise(volume, guide, points, object.level);
}

/// Whether what is hidden in noise is more than noise: its own crests have 1.0 to 1.4 of its
/// deviation for contrast, and higher ones are rarer than any object worth the name.
bool is_more_than_noise(const HalfMaximumLevel& object, const VolumeView& volume,
                        const VolumeView& guide) {
  constexpr double kOfNoise = 1.45, kLeastShare = 0.002;  // of the voxels, on either side
  const auto side = quantiles(guide, {kLeastShare, 1 - kLeastShare});
  return object.level > side[0] && object.level < side[1] &&
         exceeds_noise(object, kOfNoise, volume, guide);
}

HalfMaximumLevel iterate_from_histogram(const VolumeView& volume, const VolumeView& guide) {
  constexpr double kPlain = 2.5;   // deviations of the noise
  constexpr double kBelow = 0.98;  // share of the voxels, where the object is small
  const bool has_bone = is_hounsfield(volume) && quantiles(volume, {0.999})[0] > kBoneHu;
  if (has_bone) return iterate_from(kBoneHu, volume, guide);
  const HalfMaximumLevel object = iterate_from(otsu_split(volume).threshold, volume, guide);
  if (exceeds_noise(object, kPlain, volume, guide)) return object;
  const HalfMaximumLevel on_edges =
      iterate_from(otsu_threshold_on_edges(smoothed(guide)), volume, guide);
  if (is_more_than_noise(on_edges, volume, guide)) return on_edges;
  HalfMaximumLevel small = iterate_from(quantiles(guide, {kBelow})[0], volume, guide);
  if (!(small.contrast.difference() > 0)) return on_edges;
  small.in_noise = !is_more_than_noise(small, volume, guide);
  return small;
}

}  // namespace

HalfMaximumLevel find_half_maximum_level(const VolumeView& volume,
                                         const HalfMaximumOptions& options) {
  const Volume guide = smoothed(volume);
  return options.start ? iterate_from(*options.start, volume, guide)
                       : iterate_from_histogram(volume, guide);
}

}  // namespace mesamis
