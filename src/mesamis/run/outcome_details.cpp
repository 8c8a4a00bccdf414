// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/outcome_details.h"

namespace mesamis {

std::vector<FoundObject> OutcomeDetails::objects() const {
  if (several) return found_objects(*several);
  return {{one->surface, wanted.front()}};
}

VolumeView OutcomeDetails::image() const {
  if (!object) return {grid, in_place};
  VolumeView view = object->volume;
  if (view.samples.empty()) view.samples = in_place;
  return view;
}

const Result* OutcomeDetails::mesh() const {
  if (one) return one->mesh.cells.empty() ? nullptr : &*one;
  return several->mesh ? &*several->mesh : nullptr;
}

const std::vector<double>& OutcomeDetails::expected_error(std::size_t n) const {
  return one ? one->expected_error : several->objects[n].expected_error;
}

Segment one_object() { return {"object", 1, 0, default_colour(1)}; }

}  // namespace mesamis
