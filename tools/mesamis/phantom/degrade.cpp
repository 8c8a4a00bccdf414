// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/degrade.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/image/gaussian.h"

namespace mesamis::detail::phantom {
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

/// @param first  the place of the first sample in the whole image.
void add_noise(std::vector<float>& samples, std::size_t first, const DegradeOptions& options) {
  if (options.speckle <= 0 && options.noise <= 0 && options.salt_pepper <= 0) return;
  const Random speckle(options.seed, Purpose::kSpeckle), noise(options.seed, Purpose::kNoise);
  const Random salt_pepper(options.seed, Purpose::kSaltPepper);
  parallel_for(samples.size(), [&](std::size_t i) {
    const std::size_t n = first + i;
    double value = samples[i];
    if (options.speckle > 0) value += value * options.speckle * speckle.normal(n);
    if (options.noise > 0) value += options.noise * noise.normal(n);
    if (options.salt_pepper > 0 && salt_pepper.uniform(n) < options.salt_pepper) {
      value = salt_pepper.uniform(n, 1) < 0.5 ? options.pepper : options.salt;
    }
    samples[i] = static_cast<float>(value);
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
  volume = gaussian_smoothed(std::move(volume), options.blur);
  add_noise(volume.samples, 0, options);
  return volume;
}

DegradedSlices::DegradedSlices(const SliceSource& sharp, const DegradeOptions& options)
    : sharp_(sharp), options_(options) {
  require_valid(options);
}

std::vector<float> DegradedSlices::read(Index first, Index count) const {
  const Index reach = gaussian_reach(options_.blur);
  const Index begin = std::max(first - reach, 0);
  const Index end = std::min(first + count + reach, grid().size[2]);
  Volume slab = gaussian_smoothed(read_slab(sharp_, begin, end - begin), options_.blur);
  std::vector<float>& samples = slab.samples;
  samples.erase(samples.begin(),
                samples.begin() + static_cast<std::ptrdiff_t>(grid().offset(0, 0, first - begin)));
  samples.resize(grid().offset(0, 0, count));
  add_noise(samples, grid().offset(0, 0, first), options_);
  return std::move(samples);
}

Index DegradedSlices::slab() const {
  return slab_slices(grid(), 2 * gaussian_reach(options_.blur));
}

}  // namespace mesamis::detail::phantom
