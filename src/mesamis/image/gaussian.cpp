// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/gaussian.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::image {
namespace {

/// Weights at distance 0, 1, ...; they add up to 1 together with their mirror images.
std::vector<double> gaussian_weights(double sigma) {
  const auto radius = static_cast<std::size_t>(gaussian_reach(sigma));
  std::vector<double> weights;
  double sum = 0;
  for (std::size_t i = 0; i <= radius; ++i) {
    const double x = static_cast<double>(i) / sigma;
    weights.push_back(std::exp(-0.5 * x * x));
    sum += (i > 0 ? 2 : 1) * weights.back();
  }
  for (double& w : weights) w /= sum;
  return weights;
}

/// Convolves `width` parallel lines at once: sample i of line x is at samples[i * stride + x].
/// @param old  scratch space for the samples before.
void convolve_lines(float* samples, std::size_t count, std::size_t stride, std::size_t width,
                    const std::vector<double>& weights, std::vector<float>& old) {
  old.resize(count * width);
  for (std::size_t i = 0; i < count; ++i) {
    std::copy_n(samples + i * stride, width, old.begin() + static_cast<std::ptrdiff_t>(i * width));
  }
  std::vector<double> sum(width);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t x = 0; x < width; ++x) sum[x] = weights[0] * old[i * width + x];
    for (std::size_t d = 1; d < weights.size(); ++d) {
      const float* below = old.data() + (i < d ? 0 : i - d) * width;
      const float* above = old.data() + std::min(i + d, count - 1) * width;
      for (std::size_t x = 0; x < width; ++x) {
        sum[x] += weights[d] * (double{below[x]} + double{above[x]});
      }
    }
    for (std::size_t x = 0; x < width; ++x) samples[i * stride + x] = static_cast<float>(sum[x]);
  }
}

void convolve(Volume& volume, double sigma) {
  const std::vector<double> weights = gaussian_weights(sigma);
  const auto nx = static_cast<std::size_t>(volume.size[0]);
  const auto ny = static_cast<std::size_t>(volume.size[1]);
  const auto nz = static_cast<std::size_t>(volume.size[2]);
  float* samples = volume.samples.data();
  parallel_for_each(nz, [&](std::size_t k) {
    std::vector<float> old;
    float* slice = samples + k * nx * ny;
    for (std::size_t j = 0; j < ny; ++j) convolve_lines(slice + j * nx, nx, 1, 1, weights, old);
    convolve_lines(slice, ny, nx, nx, weights, old);
  });
  parallel_for_each(ny, [&](std::size_t j) {
    std::vector<float> old;
    convolve_lines(samples + j * nx, nz, nx * ny, nx, weights, old);
  });
}

}  // namespace

Index gaussian_reach(double sigma) { return static_cast<Index>(std::ceil(4 * sigma)); }

Volume gaussian_smoothed(Volume volume, double sigma) {
  if (!(sigma >= 0 && sigma <= 100)) {
    throw InputError("gaussian: expected a standard deviation of 0 to 100 voxels, found " +
                     std::to_string(sigma));
  }
  if (volume.samples.size() != volume.voxel_count()) {
    throw InputError("gaussian: expected " + std::to_string(volume.voxel_count()) +
                     " samples, found " + std::to_string(volume.samples.size()));
  }
  if (sigma > 0) convolve(volume, sigma);
  return volume;
}

}  // namespace mesamis::detail::image
