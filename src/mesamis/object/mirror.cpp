// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/mirror.h"

#include <algorithm>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::object {

Volume mirrored(Volume volume) {
  parallel_for(volume.samples.size(),
               [&](std::size_t n) { volume.samples[n] = -volume.samples[n]; });
  return volume;
}

GreyMap ImageUnits::turned(const GreyMap& map) const noexcept {
  const Window window = turned(Window{map.low, map.high});
  return {window.low, window.high, map.has_threshold() ? turned(map.threshold) : window.low};
}

Tissue ImageUnits::turned(Tissue tissue) const {
  tissue.values = turned(tissue.values);
  tissue.levels = turned(tissue.levels);
  if (tissue.start) tissue.start = turned(*tissue.start);
  return tissue;
}

Volume within_range(Volume volume, const Window& range) {
  if (!(range.low < range.high)) {
    std::ostringstream message;
    message << "range: expected low below high, found " << range.low << " and " << range.high;
    throw InputError(message.str());
  }
  parallel_for(volume.samples.size(), [&](std::size_t n) {
    const double x = volume.samples[n];
    volume.samples[n] = static_cast<float>(std::min(x - range.low, range.high - x));
  });
  return volume;
}

}  // namespace mesamis::detail::object
