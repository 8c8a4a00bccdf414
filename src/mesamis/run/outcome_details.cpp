// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/outcome_details.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "mesamis/method/chosen_run.h"
#include "mesamis/report/label_report.h"

namespace mesamis::detail::run {
namespace {

/// What was asked for of the object, with what the settings say of it.
ObjectRequest completed(const Request& request) {
  const ObjectRequest by_settings = object_request(request.settings);
  ObjectRequest object = request.object;
  object.level = by_settings.level;
  object.measure_level = by_settings.measure_level && !request.labels;
  object.local_level = by_settings.local_level;
  object.has_labels = request.labels.has_value();
  if (object.crop == CropRange{}) object.crop = by_settings.crop;
  if (object.has_labels && object.surroundings == SurroundingsRule::kRemoveIfPatient) {
    object.surroundings = SurroundingsRule::kKeep;
  }
  return object;
}

/// The scan of a request that has one.
VolumeView view_of(const Request& request) {
  if (const auto* volume = std::get_if<Volume>(&request.scan)) return *volume;
  return std::get<VolumeView>(request.scan);
}

/// Copies the samples only where they change.
ChosenObject choose(Request& request, const ObjectRequest& wanted,
                    std::span<const float>& in_place) {
  if (auto* volume = std::get_if<Volume>(&request.scan)) {
    return choose_object(std::move(*volume), wanted);
  }
  const auto& view = std::get<VolumeView>(request.scan);
  if (auto same = choose_in_place(view, wanted)) {
    in_place = view.samples;
    return *std::move(same);
  }
  return choose_object(copy_volume(view), wanted);
}

}  // namespace

void tell(const std::function<void(const std::string&)>& hear,
          const std::vector<std::string>& lines) {
  if (!hear) return;
  for (const std::string& line : lines) hear(line);
}

void choose_image(Request& request, const Listener& listener, OutcomeDetails& outcome) {
  outcome.object_asked = completed(request);
  const VolumeView scan = view_of(request);
  require_usable(scan);
  outcome.grid = scan;
  outcome.object = choose(request, outcome.object_asked, outcome.in_place);
  tell(listener.note, outcome.object->notes);
  tell(listener.warning, outcome.object->warnings);
}

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

std::int64_t shared_triangles(std::span<const FoundObject> objects) {
  using Corner = std::array<double, 3>;
  std::vector<std::array<Corner, 3>> all;
  for (const FoundObject& object : objects) {
    const auto& [points, triangles] = object.surface;
    for (const Triangle& t : triangles) {
      std::array<Corner, 3>& corners = all.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = points[t[i]];
        corners[i] = {p.x, p.y, p.z};
      }
      std::sort(corners.begin(), corners.end());
    }
  }
  std::sort(all.begin(), all.end());
  return std::distance(std::unique(all.begin(), all.end()), all.end());
}

std::vector<std::string> triangle_warnings(const OutcomeDetails& outcome) {
  const Parameters& p = outcome.parameters();
  if (p.triangles == 0 || p.surface != SurfaceKind::kSolid || !p.tolerance) return {};
  const std::vector<FoundObject> objects = outcome.objects();
  std::int64_t found = -shared_triangles(objects);
  for (const FoundObject& object : objects) found += std::ssize(object.surface.triangles);
  std::string line = triangles_unmet(p.triangles, found, *p.tolerance);
  return line.empty() ? std::vector<std::string>{} : std::vector{std::move(line)};
}

void judge_surfaces(OutcomeDetails& outcome) {
  for (const FoundObject& object : outcome.objects()) {
    outcome.checks.push_back(check_surface(object.surface));
  }
  outcome.verdict = outcome.one ? judge(*outcome.one, outcome.checks.front())
                                : judge(*outcome.several, outcome.checks);
  const std::string& of_body = outcome.elements.unmet;
  if (!of_body.empty()) add_unmet(outcome.verdict, "--body: " + of_body);
}

Segment one_object() { return {"object", 1, 0, default_colour(1)}; }

}  // namespace mesamis::detail::run
