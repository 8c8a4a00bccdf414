// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/grey_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::image {
namespace {

struct Histogram {
  double low, width;  // of the range and of one bin
  std::vector<std::int64_t> counts;
  double value(std::size_t bin) const { return low + width * (static_cast<double>(bin) + 0.5); }
};

/// Samples whose counts are added up before they are added to the whole.
constexpr std::size_t kPart = 1 << 20;

Histogram histogram(std::span<const float> samples) {
  constexpr std::size_t kBins = 4096;
  const auto [low, high] = sample_range(samples);
  Histogram h{low, (static_cast<double>(high) - low) / kBins, std::vector<std::int64_t>(kBins, 0)};
  if (!(h.width > 0)) h.width = 1;
  std::vector<std::vector<std::int32_t>> parts((samples.size() + kPart - 1) / kPart);
  parallel_blocks(samples.size(), kPart, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t>& counts = parts[begin / kPart];
    counts.assign(kBins, 0);
    for (std::size_t n = begin; n < end; ++n) {
      const auto bin = static_cast<std::int32_t>((samples[n] - h.low) / h.width);
      ++counts[static_cast<std::size_t>(std::min<std::int32_t>(bin, kBins - 1))];
    }
  });
  for (const auto& counts : parts) {
    for (std::size_t bin = 0; bin < kBins; ++bin) h.counts[bin] += counts[bin];
  }
  return h;
}

/// Smooths rows along an axis: of three rows one after the other, a quarter, a half and a quarter.
void smooth_rows(const float* before, const float* here, const float* after, std::size_t width,
                 float* result) {
  for (std::size_t x = 0; x < width; ++x) {
    result[x] = (before[x] + 2 * here[x] + after[x]) / 4;
  }
}

/// Smooths layer by layer, so that the samples are read and written once.
class LayerSmoother {
 public:
  explicit LayerSmoother(const VolumeView& volume)
      : volume_(volume),
        nx_(static_cast<std::size_t>(volume.size[0])),
        ny_(static_cast<std::size_t>(volume.size[1])),
        last_(volume.size[2] - 1) {
    constexpr double kClose = 2;
    const double close = kClose * volume.shortest_side();
    for (int a = 0; a < 3; ++a) along_[static_cast<std::size_t>(a)] = volume.spacing[a] <= close;
  }

  /// Smooths the layers [begin, end).
  void run(Index begin, Index end, float* result) const {
    std::array<std::vector<float>, 3> ring;
    if (along_[2]) fill(begin - 1, ring);
    fill(begin, ring);
    for (Index k = begin; k < end; ++k) {
      float* out = result + volume_.offset(0, 0, k);
      const float* here = at(k, ring);
      if (along_[2]) {
        fill(k + 1, ring);
        smooth_rows(at(k - 1, ring), here, at(k + 1, ring), nx_ * ny_, out);
      } else {
        std::copy_n(here, nx_ * ny_, out);
        if (k + 1 < end) fill(k + 1, ring);
      }
    }
  }

 private:
  using Ring = std::array<std::vector<float>, 3>;

  /// A layer smoothed along x and y; beyond the border the last one.
  const float* at(Index k, const Ring& ring) const {
    return ring[static_cast<std::size_t>(std::clamp(k, 0, last_) % 3)].data();
  }

  void fill(Index k, Ring& ring) const {
    if (k < 0 || k > last_) return;
    std::vector<float>& layer = ring[static_cast<std::size_t>(k % 3)];
    layer.resize(nx_ * ny_);
    const float* samples = volume_.samples.data() + volume_.offset(0, 0, k);
    if (along_[0]) {
      for (std::size_t j = 0; j < ny_; ++j) smooth_line(samples + j * nx_, &layer[j * nx_]);
    } else {
      std::copy_n(samples, nx_ * ny_, layer.data());
    }
    if (along_[1]) smooth_along_y(layer.data());
  }

  void smooth_line(const float* line, float* result) const {
    const std::size_t last = nx_ - 1;
    if (last == 0) {
      smooth_rows(line, line, line, 1, result);
      return;
    }
    smooth_rows(line, line, line + 1, 1, result);
    smooth_rows(line, line + 1, line + 2, last - 1, result + 1);
    smooth_rows(line + last - 1, line + last, line + last, 1, result + last);
  }

  void smooth_along_y(float* layer) const {
    std::vector<float> before(layer, layer + nx_), here(nx_);
    for (std::size_t j = 0; j < ny_; ++j) {
      float* row = layer + j * nx_;
      std::copy_n(row, nx_, here.data());
      const float* after = j + 1 < ny_ ? row + nx_ : here.data();
      smooth_rows(before.data(), here.data(), after, nx_, row);
      std::swap(before, here);
    }
  }

  const VolumeView& volume_;
  std::size_t nx_, ny_;
  Index last_;
  std::array<bool, 3> along_{};
};

/// How many samples lie in bins of 20 units around those of air and tissue.
class HounsfieldCounts {
 public:
  explicit HounsfieldCounts(std::span<const float> samples) : all_(samples.size()) {
    std::vector<std::vector<std::size_t>> parts((samples.size() + kPart - 1) / kPart);
    parallel_blocks(samples.size(), kPart, [&](std::size_t begin, std::size_t end) {
      std::vector<std::size_t>& counts = parts[begin / kPart];
      counts.assign(kBins, 0);
      for (std::size_t n = begin; n < end; ++n) ++counts[bin_of(samples[n])];
    });
    counts_.assign(kBins, 0);
    for (const auto& counts : parts) {
      for (std::size_t bin = 0; bin < kBins; ++bin) counts_[bin] += counts[bin];
    }
    zeros_ = static_cast<std::size_t>(std::count(samples.begin(), samples.end(), 0.0F));
  }

  /// A peak at that of air, with hardly anything just below.
  bool has_air() const {
    const std::size_t air = within(-1100, -840), below = within(-1500, -1100);
    return 200 * air >= all_ && air > 0 && air >= 2 * below && within(0, kHigh) > 0;
  }

  /// Fat, soft tissue and something brighter, above a floor that is air's or none.
  bool has_tissue() const {
    const std::size_t dark = within(-1500, -1100), bright = within(200, kHigh);
    // Fat is no tail of the noise around 0.
    const bool fat = 200 * within(-140, -20) >= all_ && 4000 * within(-140, -60) >= all_;
    return is_of_tissue() && fat && 4 * within(-200, 300) >= all_ && 1000 * dark <= all_ &&
           2000 * bright >= all_ && 20 * zeros_ < all_;
  }

 private:
  // The first and the last bin hold all beyond.
  static constexpr int kLow = -1520, kHigh = 1520, kWidth = 20;
  static constexpr std::size_t kBins = (kHigh - kLow) / kWidth + 1;

  static std::size_t bin_of(float sample) {
    const double bin = std::floor((static_cast<double>(sample) - kLow) / kWidth);
    return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(kBins - 1)));
  }
  /// Samples from `low` on and below `high`; up to kHigh: all that are brighter too.
  std::size_t within(int low, int high) const {
    const auto begin = counts_.begin() + (low - kLow) / kWidth;
    const auto end = high == kHigh ? counts_.end() : counts_.begin() + (high - kLow) / kWidth;
    return std::accumulate(begin, end, std::size_t{0});
  }
  /// Whether the fullest bin is one of fat or soft tissue, or the least samples are air.
  bool is_of_tissue() const {
    const auto fullest = std::max_element(counts_.begin() + 1, counts_.end() - 1);
    const int mode = kLow + kWidth * static_cast<int>(fullest - counts_.begin());
    const bool ends_at_air = within(kLow, -1100) == 0 && within(-1100, -840) > 0;
    return (mode >= -140 && mode < 140) || ends_at_air;
  }

  std::size_t all_, zeros_ = 0;
  std::vector<std::size_t> counts_;
};

}  // namespace

std::pair<float, float> sample_range(std::span<const float> samples) {
  std::vector<std::pair<float, float>> parts((samples.size() + kPart - 1) / kPart);
  parallel_blocks(samples.size(), kPart, [&](std::size_t begin, std::size_t end) {
    float low = samples[begin], high = low;
    for (std::size_t n = begin; n < end; ++n) {
      low = samples[n] < low ? samples[n] : low;
      high = samples[n] > high ? samples[n] : high;
    }
    parts[begin / kPart] = {low, high};
  });
  std::pair<float, float> range = parts.front();
  for (const auto& [low, high] : parts) {
    range = {std::min(range.first, low), std::max(range.second, high)};
  }
  return range;
}

Volume apply(const GreyMap& map, Volume volume) {
  if (!(map.low < map.high)) {
    throw InputError("window: expected low below high, found " + std::to_string(map.low) + " and " +
                     std::to_string(map.high));
  }
  const double floor = std::clamp(map.to_grey(map.threshold), 0.0, 255.0);
  parallel_for(volume.samples.size(), [&](std::size_t i) {
    float& sample = volume.samples[i];
    sample = static_cast<float>(std::clamp(map.to_grey(sample), floor, 255.0));
  });
  return volume;
}

std::vector<double> quantiles(std::span<const float> samples,
                              const std::vector<double>& fractions) {
  const Histogram h = histogram(samples);
  std::vector<double> values;
  for (const double fraction : fractions) {
    const double goal = fraction * static_cast<double>(samples.size());
    std::size_t bin = 0;
    double below = static_cast<double>(h.counts[0]);
    while (below < goal && bin + 1 < h.counts.size()) below += static_cast<double>(h.counts[++bin]);
    values.push_back(h.value(bin));
  }
  return values;
}

OtsuSplit otsu_split(std::span<const float> samples, double limit) {
  Histogram h = histogram(samples);
  while (h.counts.size() > 1 && h.value(h.counts.size() - 1) >= limit) h.counts.pop_back();
  double total = 0, total_sum = 0;
  for (std::size_t b = 0; b < h.counts.size(); ++b) {
    total += static_cast<double>(h.counts[b]);
    total_sum += static_cast<double>(h.counts[b]) * h.value(b);
  }
  double below = 0, below_sum = 0, best = -1;
  OtsuSplit split{h.low, h.low, h.low};
  for (std::size_t b = 0; b + 1 < h.counts.size(); ++b) {
    below += static_cast<double>(h.counts[b]);
    below_sum += static_cast<double>(h.counts[b]) * h.value(b);
    if (below == 0 || below == total) continue;
    const double mean_below = below_sum / below;
    const double mean_above = (total_sum - below_sum) / (total - below);
    const double between = below * (total - below) * std::pow(mean_above - mean_below, 2);
    if (between > best) {
      best = between;
      split = {h.value(b) + h.width / 2, mean_below, mean_above};
    }
  }
  return split;
}

bool is_hounsfield(const VolumeView& volume) {
  if (volume.modality == "CT") return true;
  if (!volume.modality.empty()) return false;
  const HounsfieldCounts counts(volume.samples);
  return counts.has_air() || counts.has_tissue();
}

Window default_window(const VolumeView& volume, double background) {
  constexpr double kDarkest = -200;
  const auto q = quantiles(volume.samples, {0.001, 0.999});
  if (is_hounsfield(volume)) {
    return {background > kDarkest ? kDarkest : q[0], std::clamp(q[1], 800.0, 2000.0)};
  }
  if (q[0] < q[1]) return {q[0], q[1]};
  const auto [low, high] = sample_range(volume.samples);
  return {low, high};
}

Volume clamped(const VolumeView& volume, const Window& window) {
  Volume result{volume, std::vector<float>(volume.samples.size())};
  const auto low = static_cast<float>(window.low), high = static_cast<float>(window.high);
  parallel_for(result.samples.size(), [&](std::size_t n) {
    result.samples[n] = std::clamp(volume.samples[n], low, high);
  });
  return result;
}

Volume smoothed(const VolumeView& volume) {
  constexpr std::size_t kLayers = 16;  // that one thread smooths; one more on either side is read
  Volume result{volume, std::vector<float>(volume.samples.size())};
  const LayerSmoother smoother(volume);
  parallel_blocks(
      static_cast<std::size_t>(volume.size[2]), kLayers, [&](std::size_t begin, std::size_t end) {
        smoother.run(static_cast<Index>(begin), static_cast<Index>(end), result.samples.data());
      });
  return result;
}

}  // namespace mesamis::detail::image
