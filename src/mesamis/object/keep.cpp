// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/keep.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/object/voxel_distance.h"

namespace mesamis::detail::object {
namespace {

/// Voxels over which what is outside fades.
constexpr double kFade = 2;
constexpr double kRounding = 1e-6;

/// Falls smoothly from 1 at 0 to 0 at 1.
double fade(double t) {
  const double left = 1 - std::clamp(t, 0.0, 1.0);
  return left * left * (3 - 2 * left);
}

void require_valid(const KeepOptions& options) {
  std::ostringstream message;
  if (!(options.margin >= 0)) {
    message << "margin: expected mm of at least 0, found " << options.margin;
  } else if (!std::isfinite(options.background)) {
    message << "background: expected a number, found " << options.background;
  }
  if (!message.str().empty()) throw InputError(message.str());
}

}  // namespace

Volume kept_to(Volume volume, std::span<const std::uint8_t> mask, const KeepOptions& options) {
  require_valid(options);
  require_mask_of(mask, volume);
  if (count_marked(mask) == 0) throw InputError("mask: expected an object, found no voxel marked");
  const std::vector<float> distance = distance_to_mask(mask, volume);
  const double background = options.background, width = kFade * volume.voxel_size();
  parallel_for(volume.samples.size(), [&](std::size_t n) {
    const double beyond = distance[n] - options.margin;
    const double above = volume.samples[n] - background;
    if (beyond <= kRounding * options.margin || above <= 0) return;
    volume.samples[n] = static_cast<float>(background + fade(beyond / width) * above);
  });
  return volume;
}

Volume without(Volume volume, std::span<const std::uint8_t> mask, const KeepOptions& options) {
  require_mask_of(mask, volume);
  return kept_to(std::move(volume), complement(mask), options);
}

}  // namespace mesamis::detail::object
