// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/segment.h"

#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/method/chosen_run.h"
#include "mesamis/method/label_surfaces.h"
#include "mesamis/report/label_report.h"
#include "mesamis/report/run_surface.h"
#include "mesamis/run/outcome_details.h"

namespace mesamis {
namespace {

void require_scan_where_needed(const Request& request) {
  if (request.has_scan()) return;
  if (!request.labels) throw InputError("request: expected a scan or labels, found neither");
  if (request.mesh) throw InputError("mesh: expected a scan beside the labels, found none");
  if (request.settings.accuracy) {
    throw InputError("accuracy: expected a scan beside the labels, found none");
  }
  if (request.elements.body) {
    throw InputError("body: expected a scan beside the labels, found none");
  }
}

void add_warnings(const Listener& listener, OutcomeDetails& outcome,
                  const std::vector<std::string>& lines) {
  outcome.warnings.insert(outcome.warnings.end(), lines.begin(), lines.end());
  tell(listener.warning, lines);
}

void run_one(const Request& request, const Listener& listener, OutcomeDetails& outcome) {
  outcome.wanted = {one_object()};
  const ObjectInPlace object{*outcome.object, outcome.image()};
  outcome.one = run_on_object(object, request.settings, listener.progress, request.enough);
}

/// @param choice  labels of the request, or the parts of several seeds.
void run_several(const Request& request, const LabelChoice& choice, const Listener& listener,
                 OutcomeDetails& outcome) {
  outcome.wanted = choice.wanted();
  if (listener.objects) listener.objects(outcome.wanted);
  if (request.enough) {
    throw InputError("time limit: expected a run for one object, found several");
  }
  add_warnings(listener, outcome, noise_warnings(choice.map));
  const LabelRequest labels{choice.map, choice.chosen, choice.margin, request.mesh,
                            choice.exact_by ? &*choice.exact_by : nullptr};
  outcome.several = outcome.object
                        ? run_on_labels(ObjectInPlace{*outcome.object, outcome.image()}, labels,
                                        request.settings, listener.progress)
                        : surfaces_of_labels(labels, request.settings, listener.progress);
  add_warnings(listener, outcome, missing_objects(*outcome.several, outcome.wanted));
  add_warnings(listener, outcome, changed_volumes(*outcome.several, choice.map));
}

/// The surface of elements in the place of the one that they were made for, with its errors.
void take_skin(TriMesh skin, TriMesh& surface, std::vector<double>& errors) {
  if (!errors.empty()) errors = carried_errors(surface, errors, skin.points);
  surface = std::move(skin);
}

void fill(const Request& request, const Progress& progress, OutcomeDetails& outcome) {
  if (!request.elements.wanted()) return;
  if (outcome.one) require_surface(*outcome.one, outcome.asked);
  const std::vector<FoundObject> objects = outcome.objects();
  const VolumeView image = outcome.image();
  const VoxelGrid& grid = outcome.object ? static_cast<const VoxelGrid&>(image) : outcome.grid;
  outcome.elements = make_elements(
      request.elements, {objects, grid, image, outcome.parameters(), request.settings.tolerance},
      progress);
  auto& skins = outcome.elements.skins;
  for (std::size_t n = 0; n < skins.size(); ++n) {
    if (outcome.one) {
      take_skin(std::move(skins[n]), outcome.one->surface, outcome.one->expected_error);
    } else {
      LabelledObject& object = outcome.several->objects[n];
      take_skin(std::move(skins[n]), object.surface, object.expected_error);
    }
  }
  skins.clear();
}

/// Warns where a surface may show something else than what was meant.
void warn_of_surface(const Listener& listener, OutcomeDetails& outcome) {
  if (!outcome.one || outcome.parameters().surface != SurfaceKind::kSolid) return;
  add_warnings(listener, outcome,
               surface_warnings(*outcome.object, outcome.image(), outcome.parameters().level));
}

}  // namespace

Outcome segment(Request request, const Listener& listener) {
  require_scan_where_needed(request);
  if (request.labels || request.object.seeds.size() > 1) require_solids(request.settings);
  OutcomeDetails outcome;
  outcome.asked = request.settings;
  if (request.has_scan()) {
    choose_image(request, listener, outcome);
  } else {
    outcome.grid = request.labels->map;
  }
  if (request.labels) {
    run_several(request, *request.labels, listener, outcome);
  } else if (outcome.object->parts) {
    run_several(request, {*outcome.object->parts}, listener, outcome);
  } else {
    run_one(request, listener, outcome);
  }
  add_warnings(listener, outcome, triangle_warnings(outcome));
  fill(request, listener.progress, outcome);
  warn_of_surface(listener, outcome);
  judge_surfaces(outcome);
  return Outcome(std::move(outcome));
}

}  // namespace mesamis
