// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/tissue_threshold.h"

#include <algorithm>
#include <array>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"

namespace mesamis::detail::restore {
namespace {

/// Where the tissue around `value` ends upwards: right of its peak in the histogram, the first bin
/// of at most a tenth of the peak.
double upper_end_of_tissue(const VolumeView& volume, double value, double level) {
  constexpr int kBins = 64;
  const double width = (level - value) / (kBins / 2.0);  // the level lies in the last bin
  constexpr std::size_t kPart = 1 << 20;                 // samples
  std::vector<std::array<double, kBins>> parts((volume.samples.size() + kPart - 1) / kPart);
  parallel_blocks(volume.samples.size(), kPart, [&](std::size_t begin, std::size_t end) {
    std::array<double, kBins> counts{};
    for (const float sample : volume.samples.subspan(begin, end - begin)) {
      const double bin = (sample - value) / width + kBins / 2.0;
      if (bin >= 0 && bin < kBins) ++counts[static_cast<std::size_t>(bin)];
    }
    parts[begin / kPart] = counts;
  });
  std::array<double, kBins> counts{};
  for (const auto& part : parts) {
    for (std::size_t bin = 0; bin < kBins; ++bin) counts[bin] += part[bin];
  }
  auto bin = static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  const double tenth = counts[static_cast<std::size_t>(bin)] / 10;
  while (bin + 1 < kBins && counts[static_cast<std::size_t>(bin)] > tenth) ++bin;
  return value + (bin - kBins / 2.0) * width;
}

}  // namespace

std::optional<double> find_tissue_threshold(const VolumeView& volume,
                                            const ObjectContrast& contrast, double level,
                                            double noise) {
  constexpr double kClearOfNoise = 2.5;
  constexpr double kTwoClasses = 4;    // one class's halves are 1.6 times its noise apart
  constexpr double kThirdClass = 0.5;  // distance of the two dark classes, against the contrast
  if (!(contrast.difference() > 0)) return std::nullopt;
  const OtsuSplit dark = otsu_split(volume.samples, level);
  const double distance = dark.mean_above - dark.mean_below;
  if (distance < std::max(kThirdClass * contrast.difference(), kTwoClasses * noise)) {
    return std::nullopt;
  }
  return std::min({upper_end_of_tissue(volume, contrast.background, level),
                   contrast.background + 0.5 * (level - contrast.background),
                   level - kClearOfNoise * noise});
}

}  // namespace mesamis::detail::restore
