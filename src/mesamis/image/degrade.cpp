// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/degrade.h"

#include <numbers>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis {
namespace {

constexpr double kHuge = 1e30;  // no limit but finite

/// One kind of noise each.
enum class Purpose : std::uint64_t { kSpeckle = 1, kNoise, kSaltPepper };

/// The finaliser of SplitMix64 (Steele, Lea and Flood, 2014): every bit depends on every bit.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Random numbers that are addressed rather than drawn.
class Random {
 public:
  Random(std::uint64_t seed, Purpose purpose)
      : key_(mixed(mixed(seed) + static_cast<std::uint64_t>(purpose))) {}

  /// In (0, 1).
  double uniform(std::uint64_t voxel, std::uint64_t draw = 0) const {
    const std::uint64_t bits = mixed(key_ ^ mixed(2 * voxel + draw));
    return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
  }
  /// Standard normal, after Box and Muller.
  double normal(std::uint64_t voxel) const {
    return std::sqrt(-2 * std::log(uniform(voxel))) *
           std::cos(2 * std::numbers::pi * uniform(voxel, 1));
  }

 private:
  std::uint64_t key_;
};

/// Weights at distance 0, 1, ...; with their mirror images they add up to 1.
std::vector<double> gaussian_weights(double sigma) {
  const auto radius = static_cast<std::size_t>(std::ceil(4 * sigma));
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

/// Blurs `width` parallel lines at once: sample i of line x is at samples[i * stride + x].
/// @param line  room for the old samples.
void blur_lines(float* samples, std::size_t count, std::size_t stride, std::size_t width,
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

void blur(Volume& volume, double sigma) {
  const std::vector<double> weights = gaussian_weights(sigma);
  const auto nx = static_cast<std::size_t>(volume.size[0]);
  const auto ny = static_cast<std::size_t>(volume.size[1]);
  const auto nz = static_cast<std::size_t>(volume.size[2]);
  float* samples = volume.samples.data();
  parallel_for_each(nz, [&](std::size_t k) {
    std::vector<float> old;
    float* slice = samples + k * nx * ny;
    for (std::size_t j = 0; j < ny; ++j) blur_lines(slice + j * nx, nx, 1, 1, weights, old);
    blur_lines(slice, ny, nx, nx, weights, old);
  });
  parallel_for_each(ny, [&](std::size_t j) {
    std::vector<float> old;
    blur_lines(samples + j * nx, nz, nx * ny, nx, weights, old);
  });
}

void add_noise(Volume& volume, const DegradeOptions& options) {
  const Random speckle(options.seed, Purpose::kSpeckle), noise(options.seed, Purpose::kNoise);
  const Random salt_pepper(options.seed, Purpose::kSaltPepper);
  parallel_for(volume.samples.size(), [&](std::size_t n) {
    double value = volume.samples[n];
    if (options.speckle > 0) value += value * options.speckle * speckle.normal(n);
    if (options.noise > 0) value += options.noise * noise.normal(n);
    if (options.salt_pepper > 0 && salt_pepper.uniform(n) < options.salt_pepper) {
      value = salt_pepper.uniform(n, 1) < 0.5 ? options.pepper : options.salt;
    }
    volume.samples[n] = static_cast<float>(value);
  });
}

void require_between(const char* name, double value, double lo, double hi) {
  if (value >= lo && value <= hi) return;
  std::ostringstream message;
  message << name << ": expected " << lo;
  if (hi < kHuge) message << " to " << hi << ", found " << value;
  if (hi >= kHuge) message << " or more, found " << value;
  throw InputError(message.str());
}

}  // namespace

void require_valid(const DegradeOptions& options) {
  require_between("blur", options.blur, 0, 100);
  require_between("speckle", options.speckle, 0, kHuge);
  require_between("noise", options.noise, 0, kHuge);
  require_between("salt-pepper", options.salt_pepper, 0, 1);
  require_between("pepper", options.pepper, -kHuge, kHuge);
  require_between("salt", options.salt, -kHuge, kHuge);
}

Volume degrade(Volume volume, const DegradeOptions& options) {
  require_valid(options);
  if (options.blur > 0) blur(volume, options.blur);
  if (options.speckle > 0 || options.noise > 0 || options.salt_pepper > 0) {
    add_noise(volume, options);
  }
  return volume;
}

}  // namespace mesamis
