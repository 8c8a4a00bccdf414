// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/object_report.h"

#include <nlohmann/json.hpp>

namespace mesamis::detail::report {
namespace {

using nlohmann::ordered_json;

const char* source_name(LevelSource source) {
  switch (source) {
    case LevelSource::kRun:
      return "run";
    case LevelSource::kUser:
      return "user";
    case LevelSource::kScan:
      return "whole scan";
    case LevelSource::kCrop:
      return "crop";
    case LevelSource::kTissue:
      return "tissue";
    case LevelSource::kLabels:
      return "labels";
  }
  return "";
}

const char* image_name(TissueKind kind) {
  switch (kind) {
    case TissueKind::kBright:
      return "scan";
    case TissueKind::kDark:
      return "mirrored";
    case TissueKind::kRange:
      return "within range";
  }
  return "";
}

ordered_json padding_json(const std::optional<FilledPadding>& padding) {
  if (!padding) return nullptr;
  return {{"voxels", padding->voxels}, {"value", padding->value}, {"filled_with", padding->filled}};
}

}  // namespace

ordered_json object_json(const ObjectRequest& request, const ChosenObject& chosen) {
  ordered_json seeds = ordered_json::array(), removed = ordered_json::array();
  for (const Vec3& p : request.seeds) seeds.push_back({p.x, p.y, p.z});
  for (const Surroundings& thing : chosen.removed) {
    removed.push_back({{"what", thing.what}, {"cm3", thing.mm3 / 1000}});
  }
  ordered_json mask;
  if (request.mask) mask = {{"margin_mm", request.margin}};
  return {{"tissue", chosen.tissue.empty() ? ordered_json(nullptr) : ordered_json(chosen.tissue)},
          {"image", image_name(chosen.kind)},
          {"level_from", source_name(chosen.level ? chosen.level->from : LevelSource::kRun)},
          {"mask", std::move(mask)},
          {"seeds_mm", std::move(seeds)},
          {"removed", std::move(removed)},
          {"padding", padding_json(chosen.padding)}};
}

}  // namespace mesamis::detail::report
