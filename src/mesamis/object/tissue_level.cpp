// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/tissue_level.h"

#include <algorithm>

#include "mesamis/base/error.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/restore/object_edge.h"

namespace mesamis::detail::object {
namespace {

/// The edge of the bright object of a volume.
HalfMaximumLevel measure(const VolumeView& volume, const std::optional<double>& start) {
  const HalfMaximumLevel seen = find_half_maximum_level(volume, {.start = start});
  if (!(seen.contrast.difference() > 0)) return seen;
  const Window window = window_with_room(volume, seen.contrast, seen.level);
  return find_object_edge(clamped(volume, window), seen);
}

}  // namespace

void require_hounsfield(const VolumeView& scan, const Tissue& tissue) {
  if (!tissue.hounsfield || is_hounsfield(scan)) return;
  throw InputError("tissue: expected a CT scan in Hounsfield units for " + tissue.name +
                   ", found other values (--modality CT if it is one); dark and LO:HI fit "
                   "any scan");
}

TissueLevel find_tissue_level(const VolumeView& image, const Tissue& tissue) {
  TissueLevel result;
  if (tissue.level_is_given()) {
    result.level = tissue.levels.low;
    return result;
  }
  const HalfMaximumLevel object = measure(image, tissue.start);
  if (object.contrast.difference() == 0 || object.in_noise) {
    if (!tissue.start) {
      throw InputError("tissue: expected an object that stands out from the noise, found none");
    }
    result.level = *tissue.start;
    return result;
  }
  result.level = std::clamp(object.level, tissue.levels.low, tissue.levels.high);
  result.contrast = object.contrast;
  result.uncertainty = object.uncertainty;
  result.bounded = result.level != object.level;
  result.measured = !result.bounded;
  return result;
}

}  // namespace mesamis::detail::object
