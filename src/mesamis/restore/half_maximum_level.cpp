// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/half_maximum_level.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/restore/scan_quality.h"

namespace mesamis::detail::restore {
namespace {

constexpr double kBoneHu = 200;
constexpr int kMostIterations = 10;
constexpr double kTolerance = 0.005;  // change of the level, against the contrast
constexpr std::size_t kMostPoints = 200'000;

/// The norms of the gradients (gradient_at()) of a row of voxels.
void find_gradient_norms(const VolumeView& volume, Index j, Index k, std::vector<double>& norms) {
  const auto [nx, ny, nz] = volume.size;
  const Index y_low = std::max(j - 1, 0), y_high = std::min(j + 1, ny - 1);
  const Index z_low = std::max(k - 1, 0), z_high = std::min(k + 1, nz - 1);
  const auto row = [&](Index y, Index z) { return volume.samples.data() + volume.offset(0, y, z); };
  const float *here = row(j, k), *below = row(y_low, k), *above = row(y_high, k),
              *before = row(j, z_low), *after = row(j, z_high);
  const Vec3& s = volume.spacing;
  const Vec3 apart{2 * s.x, (y_high - y_low) * s.y, (z_high - z_low) * s.z};
  norms.resize(static_cast<std::size_t>(nx));
  double* of_row = norms.data();
  of_row[0] = norm(gradient_at(volume, 0, j, k));
  for (Index i = 1; i + 1 < nx; ++i) {
    const double x = (here[i + 1] - here[i - 1]) / apart.x, y = (above[i] - below[i]) / apart.y,
                 z = (after[i] - before[i]) / apart.z;
    of_row[i] = std::sqrt(x * x + y * y + z * z);
  }
  of_row[nx - 1] = norm(gradient_at(volume, nx - 1, j, k));
}

/// Calls visit(part, n, norm of the gradient) for all voxels n; the parts run concurrently, each in
/// the order of its voxels.
template <class Visit>
void for_each_gradient(const VolumeView& volume, std::size_t parts, Visit&& visit) {
  const auto layers = static_cast<std::size_t>(volume.size[2]);
  const std::size_t of_part = (layers + parts - 1) / parts;
  parallel_blocks(layers, of_part, [&](std::size_t begin, std::size_t end) {
    std::vector<double> norms;
    for (std::size_t k = begin; k < end; ++k) {
      for (Index j = 0; j < volume.size[1]; ++j) {
        find_gradient_norms(volume, j, static_cast<Index>(k), norms);
        const std::size_t first = volume.offset(0, j, static_cast<Index>(k));
        for (std::size_t i = 0; i < norms.size(); ++i) visit(begin / of_part, first + i, norms[i]);
      }
    }
  });
}

constexpr std::size_t kParts = 16;

/// The median of the gradients' norms. Their leading bits order them: a histogram of these tells in
/// which bin it lies, and the norms in that bin alone are kept.
double median_gradient(const VolumeView& volume) {
  constexpr int kDropped = 46;  // bits; the others tell a sixty-fourth of a power of two
  constexpr std::size_t kBins = std::size_t{1} << (63 - kDropped);
  const auto bin_of = [](double norm) {
    return static_cast<std::size_t>(std::bit_cast<std::uint64_t>(norm) >> kDropped);
  };
  std::vector<std::vector<std::uint32_t>> counts(kParts, std::vector<std::uint32_t>(kBins, 0));
  for_each_gradient(volume, kParts, [&](std::size_t part, std::size_t, double norm) {
    ++counts[part][bin_of(norm)];
  });
  std::size_t before = 0, bin = 0;
  const std::size_t rank = volume.voxel_count() / 2;
  for (;; ++bin) {
    std::size_t count = 0;
    for (const auto& part : counts) count += part[bin];
    if (before + count > rank) break;
    before += count;
  }
  std::vector<std::vector<double>> found(kParts);
  for_each_gradient(volume, kParts, [&](std::size_t part, std::size_t, double norm) {
    if (bin_of(norm) == bin) found[part].push_back(norm);
  });
  std::vector<double> norms;
  for (const auto& part : found) norms.insert(norms.end(), part.begin(), part.end());
  const auto middle = norms.begin() + static_cast<std::ptrdiff_t>(rank - before);
  std::nth_element(norms.begin(), middle, norms.end());
  return *middle;
}

/// Otsu's threshold of the voxels on edges: where most of the image is one tissue, the threshold of
/// all voxels splits that tissue's noise.
/// @param smooth  smoothed until edges exceed the noise.
double otsu_threshold_on_edges(const VolumeView& smooth) {
  constexpr double kOfMedian = 4;  // a gradient of noise is hardly ever that large
  const double least = kOfMedian * median_gradient(smooth);
  std::vector<std::vector<float>> found(kParts);
  for_each_gradient(smooth, kParts, [&](std::size_t part, std::size_t n, double norm) {
    if (norm > least) found[part].push_back(smooth.samples[n]);
  });
  std::vector<float> on_edges;
  for (const auto& part : found) on_edges.insert(on_edges.end(), part.begin(), part.end());
  return otsu_split(on_edges.empty() ? smooth.samples : on_edges).threshold;
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
  const auto side = quantiles(guide.samples, {kLeastShare, 1 - kLeastShare});
  return object.level > side[0] && object.level < side[1] &&
         exceeds_noise(object, kOfNoise, volume, guide);
}

HalfMaximumLevel iterate_from_histogram(const VolumeView& volume, const VolumeView& guide) {
  constexpr double kPlain = 2.5;   // deviations of the noise
  constexpr double kBelow = 0.98;  // share of the voxels, where the object is small
  const bool has_bone = is_hounsfield(volume) && quantiles(volume.samples, {0.999})[0] > kBoneHu;
  if (has_bone) return iterate_from(kBoneHu, volume, guide);
  const HalfMaximumLevel object = iterate_from(otsu_split(volume.samples).threshold, volume, guide);
  if (exceeds_noise(object, kPlain, volume, guide)) return object;
  const HalfMaximumLevel on_edges =
      iterate_from(otsu_threshold_on_edges(smoothed(guide)), volume, guide);
  if (is_more_than_noise(on_edges, volume, guide)) return on_edges;
  HalfMaximumLevel small = iterate_from(quantiles(guide.samples, {kBelow})[0], volume, guide);
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

}  // namespace mesamis::detail::restore
