// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/chosen_run.h"

#include <utility>

#include "mesamis/object/mirror.h"

namespace mesamis {
namespace {

/// With a T of the user's own the run places the level between it and the object.
bool has_own_threshold(const Settings& settings) {
  return settings.threshold_rule == ThresholdRule::kPaper ||
         settings.threshold_rule == ThresholdRule::kValue;
}

GreyMap mirrored_map(const GreyMap& map) {
  GreyMap turned{mirrored(map.high), mirrored(map.low), 0};
  turned.threshold = map.has_threshold() ? mirrored(map.threshold) : turned.low;
  return turned;
}

}  // namespace

ObjectRequest object_request(const Settings& settings) {
  const bool solid = settings.surface == SurfaceKind::kSolid;
  ObjectRequest request;
  request.crop = settings.crop;
  request.measure_level = solid && !has_own_threshold(settings);
  if (solid) request.level = settings.level;
  return request;
}

Settings settings_for(const ChosenObject& object, Settings settings) {
  settings.crop = {};
  const bool asked = !object.tissue.empty() || object.level_from == LevelSource::kUser;
  if (asked || object_request(settings).measure_level) settings.level = object.level;
  if (object.kind == TissueKind::kRange) settings.local_level = false;
  if (object.alone && settings.keep_largest == 0) settings.keep_largest = 1;
  if (object.kind == TissueKind::kDark) {
    if (settings.window) settings.window = mirrored(*settings.window);
    settings.threshold = mirrored(settings.threshold);
  }
  return settings;
}

Parameters in_scan_units(Parameters p, const ChosenObject& object) {
  for (std::size_t a = 0; a < 3; ++a) {
    const Index begin = object.crop.begin[a];
    p.crop.begin[a] += begin;
    p.crop.end[a] = p.crop.end[a] < 0 ? object.crop.end[a] : p.crop.end[a] + begin;
  }
  if (object.kind != TissueKind::kDark) return p;
  p.level = mirrored(p.level);
  p.grey = mirrored_map(p.grey);
  return p;
}

Result run_on_object(const ChosenObject& object, const Settings& settings, const Progress& progress,
                     const HasEnough& enough) {
  return run_on_object(ObjectInPlace{object, object.volume}, settings, progress, enough);
}

Result run_on_object(const ObjectInPlace& in_place, const Settings& settings,
                     const Progress& progress, const HasEnough& enough) {
  const auto& [object, image] = in_place;
  Result result = mes_amis(image, settings_for(object, settings), progress, enough);
  result.parameters = in_scan_units(result.parameters, object);
  if (object.level_uncertainty > 0) {
    result.image.level_uncertainty = object.level_uncertainty;
  }
  return result;
}

LabelResult run_on_labels(const ChosenObject& object, const LabelRequest& request,
                          const Settings& settings, const Progress& progress) {
  return run_on_labels(ObjectInPlace{object, object.volume}, request, settings, progress);
}

LabelResult run_on_labels(const ObjectInPlace& in_place, const LabelRequest& request,
                          const Settings& settings, const Progress& progress) {
  const auto& [object, image] = in_place;
  LabelResult result =
      find_labelled_objects(image, request, settings_for(object, settings), progress);
  result.parameters = in_scan_units(result.parameters, object);
  if (result.mesh) result.mesh->parameters = in_scan_units(result.mesh->parameters, object);
  if (object.kind == TissueKind::kDark) {
    for (LabelBoundary& boundary : result.boundaries) {
      boundary.level = mirrored(boundary.level);
      boundary.contrast = -boundary.contrast;
    }
  }
  return result;
}

}  // namespace mesamis
