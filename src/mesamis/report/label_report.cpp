// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/label_report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "mesamis/method/expected_error.h"
#include "mesamis/report/report.h"
#include "mesamis/report/run_summary.h"
#include "mesamis/report/settings_json.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis::detail::report {
namespace {

using nlohmann::ordered_json;

/// @param decimated  mm: no point of a boundary was moved farther; none: not known.
ordered_json object_json(const LabelledObject& object, const SurfaceCheck& check,
                         const std::optional<double>& decimated, double tolerance) {
  const ordered_json moved = decimated ? ordered_json(*decimated) : ordered_json();
  ordered_json j{{"name", object.segment.name},
                 {"label", object.segment.label},
                 {"layer", object.segment.layer},
                 {"colour", object.segment.colour},
                 {"kind", "solid"},
                 {"tolerance_mm", std::isfinite(tolerance) ? ordered_json(tolerance) : nullptr},
                 {"triangles_extracted", object.triangles_extracted},
                 {"distance_extracted_to_result_max", moved},
                 {"distance_result_to_extracted_max", moved}};
  j.update(check_json(object.surface, check));
  j["self_intersections"] = find_self_intersections(object.surface).size();
  const auto& expected = object.expected_error;
  j["expected_error_mm"] = expected.empty() ? ordered_json(nullptr)
                                            : error_json(summarize_error(object.surface, expected));
  return j;
}

ordered_json boundary_json(const LabelBoundary& boundary) {
  const auto name = [](const std::string& side) {
    return side.empty() ? ordered_json(nullptr) : ordered_json(side);
  };
  ordered_json j{{"between", {name(boundary.first), name(boundary.second)}}};
  if (boundary.followed) {
    j["level_native"] = boundary.level;
    j["contrast_native"] = boundary.contrast;
  }
  j["placed_by"] = boundary.followed ? "image" : "labels";
  return j;
}

/// Of the first object that is less accurate than was asked for, and how many more are; or empty.
std::string accuracy_unmet(const LabelResult& result) {
  std::string first;
  int more = 0;
  for (const LabelledObject& object : result.objects) {
    const std::string unmet =
        report::accuracy_unmet(result.parameters.accuracy, object.surface, object.expected_error);
    if (unmet.empty()) continue;
    if (first.empty()) {
      first = "'" + object.segment.name + "': " + unmet;
    } else {
      ++more;
    }
  }
  if (more == 0) return first;
  return first + "; " + std::to_string(more) + (more == 1 ? " more object" : " more objects") +
         " too";
}

}  // namespace

ordered_json label_run_json(const Settings& asked, const LabelResult& result,
                            std::span<const SurfaceCheck> checks) {
  const Parameters& p = result.parameters;
  const double tolerance = p.tolerance.value();
  // Without a tolerance nothing was proved.
  const auto decimated = std::isfinite(tolerance) ? std::optional(result.decimated) : std::nullopt;
  ordered_json objects = ordered_json::array(), boundaries = ordered_json::array();
  for (std::size_t n = 0; n < result.objects.size(); ++n) {
    objects.push_back(object_json(result.objects[n], checks[n], decimated, tolerance));
  }
  for (const LabelBoundary& b : result.boundaries) boundaries.push_back(boundary_json(b));
  ordered_json report;
  if (result.has_image) {
    report = settings_used_json(asked, p, result.image);
    report["settings"] = to_json(settings_used_by_labels(asked, p));
    report["chosen"].erase("level");  // each boundary has its own
  }
  report["object"] = {{"margin_mm", result.has_image ? ordered_json(result.margin) : nullptr},
                      {"tolerance_mm", tolerance},
                      {"surfaces", std::move(objects)},
                      {"boundaries", std::move(boundaries)}};
  if (result.has_image) report["converged"] = result.flow_converged;
  if (result.has_image) report["quality"] = image_json(p, result.image);
  if (result.mesh) report.update(loop_json(summarize(*result.mesh, {})));
  report["seconds_parts"] = {
      {"prepare", result.seconds.prepare}, {"flow", result.seconds.flow},
      {"surface", result.seconds.surface}, {"printable", result.seconds.printable},
      {"mesh", result.seconds.mesh},       {"method", result.seconds.total}};
  return report;
}

Settings settings_used_by_labels(const Settings& asked, const Parameters& used) {
  Settings settings = settings_of(used);
  settings.crop = asked.crop;
  settings.level = asked.level;
  settings.local_level = asked.local_level;
  return settings;
}

Verdict judge(const LabelResult& result, std::span<const SurfaceCheck> checks) {
  for (std::size_t n = 0; n < checks.size(); ++n) {
    const std::string flaws = solid_flaws_of(checks[n]);
    if (flaws.empty()) continue;
    return {VerdictKind::kNotClosed,
            "'" + result.objects[n].segment.name +
                "': expected a closed 2-manifold surface that faces outward, "
                "found " +
                flaws};
  }
  if (!result.flow_converged) {
    return {VerdictKind::kNotConverged, "not converged: a linear solve of the labels' flow"};
  }
  const std::string inaccurate = accuracy_unmet(result);
  if (!inaccurate.empty()) return {VerdictKind::kNotConverged, inaccurate};
  return {};
}

}  // namespace mesamis::detail::report
