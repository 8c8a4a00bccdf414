// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/not_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesamis::detail::image {

NotNumbers fill_not_numbers(std::span<float> samples) noexcept {
  const auto is_nan = [](float x) { return std::isnan(x); };
  const auto count = std::count_if(samples.begin(), samples.end(), is_nan);
  if (count == 0 || count == std::ssize(samples)) return {};
  float least = std::numeric_limits<float>::infinity();
  for (const float x : samples) least = x < least ? x : least;
  std::replace_if(samples.begin(), samples.end(), is_nan, least);
  return {static_cast<std::size_t>(count), least};
}

}  // namespace mesamis::detail::image
