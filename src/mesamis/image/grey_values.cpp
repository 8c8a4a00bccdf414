// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/grey_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis {
namespace {

struct Histogram {
  double low, width;  // of the range and of one bin
  std::vector<std::int64_t> counts;
  double value(std::size_t bin) const { return low + width * (static_cast<double>(bin) + 0.5); }
};

Histogram histogram(const VolumeView& volume) {
  constexpr std::size_t kBins = 4096;
  const auto [low, high] = std::minmax_element(volume.samples.begin(), volume.samples.end());
  Histogram h{*low, (static_cast<double>(*high) - *low) / kBins,
              std::vector<std::int64_t>(kBins, 0)};
  if (!(h.width > 0)) h.width = 1;
  for (const float sample : volume.samples) {
    const auto bin = static_cast<std::size_t>((sample - h.low) / h.width);
    ++h.counts[std::min(bin, kBins - 1)];
  }
  return h;
}

/// One line of samples: start, step and count.
void smooth_line(float* first, std::size_t step, std::size_t count, std::vector<float>& line) {
  line.resize(count + 2);
  for (std::size_t i = 0; i < count; ++i) line[i + 1] = first[i * step];
  line[0] = line[1];
  line[count + 1] = line[count];
  for (std::size_t i = 0; i < count; ++i) {
    first[i * step] = (line[i] + 2 * line[i + 1] + line[i + 2]) / 4;
  }
}

}  // namespace

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

std::vector<double> quantiles(const VolumeView& volume, const std::vector<double>& fractions) {
  const Histogram h = histogram(volume);
  std::vector<double> values;
  for (const double fraction : fractions) {
    const double goal = fraction * static_cast<double>(volume.samples.size());
    std::size_t bin = 0;
    double below = static_cast<double>(h.counts[0]);
    while (below < goal && bin + 1 < h.counts.size()) below += static_cast<double>(h.counts[++bin]);
    values.push_back(h.value(bin));
  }
  return values;
}

OtsuSplit otsu_split(const VolumeView& volume, double limit) {
  Histogram h = histogram(volume);
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
  const auto q = quantiles(volume, {0.01, 0.999});
  return q[0] <= -800 && q[0] >= -3100 && q[1] > 0 && q[1] < 5000;
}

Window default_window(const VolumeView& volume, double background) {
  constexpr double kDarkest = -200;
  const auto q = quantiles(volume, {0.001, 0.999});
  if (is_hounsfield(volume)) {
    return {background > kDarkest ? kDarkest : q[0], std::clamp(q[1], 800.0, 2000.0)};
  }
  if (q[0] < q[1]) return {q[0], q[1]};
  const auto [low, high] = std::minmax_element(volume.samples.begin(), volume.samples.end());
  return {*low, *high};
}

Volume smoothed(const VolumeView& volume) {
  constexpr double kClose = 2;
  Volume result = copy_volume(volume);
  const auto nx = static_cast<std::size_t>(volume.size[0]);
  const auto ny = static_cast<std::size_t>(volume.size[1]);
  const auto nz = static_cast<std::size_t>(volume.size[2]);
  float* samples = result.samples.data();
  const auto is_close = [&](double side) { return side <= kClose * volume.shortest_side(); };
  const bool along_x = is_close(volume.spacing.x), along_y = is_close(volume.spacing.y);
  parallel_for_each(nz, [&](std::size_t k) {
    std::vector<float> line;
    float* layer = samples + k * nx * ny;
    for (std::size_t j = 0; along_x && j < ny; ++j) smooth_line(layer + j * nx, 1, nx, line);
    for (std::size_t i = 0; along_y && i < nx; ++i) smooth_line(layer + i, nx, ny, line);
  });
  if (!is_close(volume.spacing.z)) return result;
  parallel_for_each(ny, [&](std::size_t j) {
    std::vector<float> line;
    for (std::size_t i = 0; i < nx; ++i) smooth_line(samples + j * nx + i, nx * ny, nz, line);
  });
  return result;
}

}  // namespace mesamis
