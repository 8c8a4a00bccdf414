// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/mirror.h"

#include <algorithm>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis {

Volume mirrored(Volume volume) {
  parallel_for(volume.samples.size(),
               [&](std::size_t n) { volume.samples[n] = -volume.samples[n]; });
  return volume;
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

}  // namespace mesamis
