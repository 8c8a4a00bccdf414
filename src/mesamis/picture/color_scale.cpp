// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/color_scale.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mesamis::detail::picture {
namespace {

// Viridis (matplotlib, CC0) at nine even steps, interpolated linearly.
constexpr std::array<Colour, 9> kViridis{{{68, 1, 84},
                                          {71, 44, 122},
                                          {59, 81, 139},
                                          {44, 113, 142},
                                          {33, 144, 141},
                                          {39, 173, 129},
                                          {92, 200, 99},
                                          {170, 220, 50},
                                          {253, 231, 37}}};
// Share of white in each colour, so that the dark edges of a mesh are visible on all of them.
constexpr double kWhite = 0.25;
constexpr std::size_t kSampleSize = 1 << 20;

std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

}  // namespace

template <class Value>
ValueRange percentile_range(std::span<const Value> values, double lo, double hi) {
  std::vector<double> sample;
  const std::size_t step = 1 + values.size() / kSampleSize;
  for (std::size_t i = 0; i < values.size(); i += step) {
    if (std::isfinite(values[i])) sample.push_back(static_cast<double>(values[i]));
  }
  if (sample.empty()) return {};
  const auto at = [&sample](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size() - 1));
    std::nth_element(sample.begin(), sample.begin() + rank, sample.end());
    return sample[static_cast<std::size_t>(rank)];
  };
  ValueRange range{at(lo), at(hi)};
  if (!(range.hi > range.lo)) range = {at(0), at(1)};
  if (!(range.hi > range.lo)) {
    const double width = std::max(1e-3 * std::abs(range.lo), 1e-12);
    range = {range.lo - width, range.lo + width};
  }
  return range;
}
template ValueRange percentile_range(std::span<const float>, double, double);
template ValueRange percentile_range(std::span<const double>, double, double);

Colour grey(double share) {
  const std::uint8_t level = to_byte(255 * share);
  return {level, level, level};
}

Colour viridis(double share) {
  const double x = std::clamp(share, 0.0, 1.0) * (kViridis.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), kViridis.size() - 2);
  const double t = x - static_cast<double>(i);
  Colour rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = (1 - t) * kViridis[i][c] + t * kViridis[i + 1][c];
    rgb[c] = to_byte((1 - kWhite) * value + kWhite * 255);
  }
  return rgb;
}

}  // namespace mesamis::detail::picture
