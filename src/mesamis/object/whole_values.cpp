// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/whole_values.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace mesamis::detail::object {
namespace {

using Counts = std::unordered_map<float, std::size_t>;

/// How often each value occurs; nothing if one is negative or has a fraction, or there are too
/// many.
std::optional<Counts> whole_values(const VolumeView& volume) {
  constexpr std::size_t kMost = 1000;
  Counts counts;
  float last = 0;
  std::size_t* count = nullptr;
  for (const float sample : volume.samples) {
    if (count == nullptr || sample != last) {
      if (sample < 0 || sample != std::floor(sample)) return std::nullopt;
      count = &counts[sample];
      last = sample;
      if (counts.size() > kMost) return std::nullopt;
    }
    ++*count;
  }
  return counts;
}

/// Whether neighbours are mostly equal where not all is background.
bool is_even(const VolumeView& volume, float background) {
  std::size_t pairs = 0, equal = 0;
  const auto row = static_cast<std::size_t>(volume.size[0]);
  for (std::size_t n = 1; n < volume.samples.size(); ++n) {
    const float a = volume.samples[n - 1], b = volume.samples[n];
    if (n % row == 0 || (a == background && b == background)) continue;
    ++pairs;
    equal += a == b;
  }
  return 2 * equal > pairs;
}

}  // namespace

std::optional<FewValues> find_few_whole_values(const VolumeView& volume) {
  const auto counts = whole_values(volume);
  if (!counts || counts->size() < 2) return std::nullopt;
  FewValues found{counts->size(), HUGE_VAL, -HUGE_VAL};
  std::size_t most = 0;
  float background = 0;
  for (const auto& [value, count] : *counts) {
    found.least = std::min<double>(found.least, value);
    found.most = std::max<double>(found.most, value);
    if (count < most || (count == most && value > background)) continue;
    most = count;
    background = value;
  }
  return is_even(volume, background) ? std::optional(found) : std::nullopt;
}

}  // namespace mesamis::detail::object
