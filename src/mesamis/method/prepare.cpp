// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/prepare.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/restore/local_level.h"
#include "mesamis/restore/restore.h"

namespace mesamis::detail::method {
namespace {

/// The restored image between its voxels, in grey values. It is bounded after it is interpolated: T
/// and the window's ends cut edges, whose place would move if only the samples were bounded.
SplineImage spline_image(const GreyMap& map, const VolumeView& restored) {
  Volume grey{restored, std::vector<float>(restored.samples.size())};
  parallel_for(grey.samples.size(), [&](std::size_t n) {
    grey.samples[n] = static_cast<float>(map.to_grey(restored.samples[n]));
  });
  SplineImage image = interpolating_spline(std::move(grey));
  image.low = static_cast<float>(std::max(0.0, map.to_grey(map.threshold)));
  image.high = 255;
  return image;
}

/// @param restored  in native units; taken over.
Prepared prepared_from(const Chosen& choice, Volume restored) {
  const GreyMap& map = choice.parameters.grey;
  Prepared prepared{choice.parameters, choice.measured, {}, spline_image(map, restored)};
  prepared.grey = apply(map, std::move(restored));
  return prepared;
}

}  // namespace

std::array<Index, 3> first_grid_size(const std::array<Index, 3>& voxels,
                                     const std::array<Index, 3>& stride) {
  std::array<Index, 3> size;
  for (std::size_t a = 0; a < 3; ++a) size[a] = std::max(2, (voxels[a] - 1) / stride[a] + 1);
  return size;
}

Prepared prepare_image(const VolumeView& volume, const ImageSettings& settings) {
  ChosenImage found = choose(volume, settings);
  Prepared prepared = prepared_from(found.chosen, std::move(found.restored));
  prepared.excess = std::move(found.excess);
  return prepared;
}

Prepared prepare_slab(const VolumeView& slab, const VolumeView& excess, const Chosen& choice) {
  const Parameters& p = choice.parameters;
  Volume image = clamped(slab, {p.grey.low, p.grey.high});
  if (p.restore) {
    image =
        restore::restore(std::move(image), choice.object, {p.noise, p.blur, choice.impulse_height})
            .volume;
  }
  take_off(excess, image);
  return prepared_from(choice, std::move(image));
}

double cells_of(const Prepared& slab) {
  const Parameters& p = slab.parameters;
  const double scale = p.grey.grey_per_native();
  return cells_of_image(
      slab.grey,
      {p.grey.to_grey(p.level), slab.measured.contrast * scale, slab.measured.noise_left * scale},
      p.accuracy);
}

}  // namespace mesamis::detail::method
