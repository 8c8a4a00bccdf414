// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/tissue_level.h"

#include <algorithm>

#include "mesamis/base/error.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/restore/object_edge.h"

namespace mesamis::detail::object {
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
  result.seen = see_object(image, {.start = tissue.start});
  const HalfMaximumLevel& object = result.seen->object;
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
