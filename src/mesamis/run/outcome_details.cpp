// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/outcome_details.h"

#include "mesamis/report/label_report.h"

namespace mesamis::detail::run {

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

void judge_surfaces(OutcomeDetails& outcome) {
  for (const FoundObject& object : outcome.objects()) {
    outcome.checks.push_back(check_surface(object.surface));
  }
  outcome.verdict = outcome.one ? judge(*outcome.one, outcome.checks.front())
                                : judge(*outcome.several, outcome.checks);
}

Segment one_object() { return {"object", 1, 0, default_colour(1)}; }

}  // namespace mesamis::detail::run
