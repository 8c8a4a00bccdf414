// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/chosen_run.h"

#include <utility>

namespace mesamis::detail::method {

ObjectRequest object_request(const Settings& settings) {
  const bool solid = settings.surface == SurfaceKind::kSolid;
  ObjectRequest request;
  request.crop = settings.crop;
  request.measure_level = solid;
  request.local_level = settings.has_local_level();
  if (solid) request.level = settings.level;
  return request;
}

ImageSettings settings_for(const ChosenObject& object, Settings settings) {
  const bool measured = object_request(settings).measure_level;
  const ImageUnits units = object.units();
  settings.crop = {};
  if (!object.may_be_bone()) settings.local_level = false;
  if (object.alone && settings.keep_largest == 0) settings.keep_largest = 1;
  if (settings.window) settings.window = units.turned(*settings.window);
  settings.threshold = units.turned(settings.threshold);
  if (settings.level) settings.level = units.turned(*settings.level);
  const bool given = object.level && object.level->from == LevelSource::kUser;
  ImageSettings of_image(settings);
  if (!object.tissue.empty() || given || measured) of_image = {settings, object.level};
  of_image.scan = object.scan;
  of_image.units = units;
  return of_image;
}

Parameters in_scan_units(Parameters p, const ChosenObject& object) {
  for (std::size_t a = 0; a < 3; ++a) {
    const Index begin = object.crop.begin[a];
    p.crop.begin[a] += begin;
    p.crop.end[a] = p.crop.end[a] < 0 ? object.crop.end[a] : p.crop.end[a] + begin;
  }
  p.level = object.units().turned(p.level);
  p.grey = object.units().turned(p.grey);
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
  auto& [low, high] = result.image.level_range;
  const Window levels = object.units().turned(Window{low, high});
  low = levels.low;
  high = levels.high;
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
  for (LabelBoundary& boundary : result.boundaries) {
    boundary.level = object.units().turned(boundary.level);
    boundary.contrast = object.units().turned(boundary.contrast);
  }
  return result;
}

}  // namespace mesamis::detail::method
