// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/body_json.h"

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesamis/report/json_file.h"

namespace mesamis::detail::report {
namespace {

using nlohmann::ordered_json;

ordered_json quality_json(const ElementQuality& quality) {
  return {{"least_angle_deg", quality.least_angle},
          {"greatest_angle_deg", quality.greatest_angle},
          {"share_above_15_deg", quality.share_above_15_deg},
          {"scaled_jacobian_min", quality.scaled_jacobian_min},
          {"share_scaled_jacobian_above_0.2", quality.share_jacobian_above}};
}

/// JSON has no infinity: null where an object has no element.
ordered_json finite(double value) { return std::isfinite(value) ? ordered_json(value) : nullptr; }

ordered_json fit_json(const MeshedBody& facts) {
  return {{"skin_to_surface_mm", finite(facts.fit.skin_to_surface)},
          {"surface_to_skin_mm", finite(facts.fit.surface_to_skin)},
          {"volume_ratio", facts.fit.volume_ratio},
          {"elements_of_skin_only", facts.fit.elements_of_skin_only},
          {"least_size_mm", facts.least_size},
          {"narrow_area_share", facts.narrow_share}};
}

ordered_json parts_json(const FiniteElements& elements) {
  std::vector<std::size_t> cells(elements.parts.size(), 0);
  for (const Index part : elements.part_of_cell) ++cells[static_cast<std::size_t>(part)];
  ordered_json parts = ordered_json::array();
  for (std::size_t p = 0; p < cells.size(); ++p) {
    const FiniteElements::Part& part = elements.parts[p];
    parts.push_back({{"name", part.name}, {"object", part.note}, {"elements", cells[p]}});
  }
  return parts;
}

ordered_json sets_json(const FiniteElements& elements) {
  ordered_json sets = ordered_json::array();
  for (const auto& set : elements.sets) {
    sets.push_back({{"name", set.name}, {"faces", set.faces.size()}, {"nodes", set.nodes.size()}});
  }
  return sets;
}

ordered_json material_json(const BodyOutput& body) {
  if (!body.material) return nullptr;
  const MaterialReport& report = *body.material;
  return {{"law", report.law},
          {"citation", report.citation},
          {"doi", report.doi},
          {"density", density_name(report.density)},
          {"density_g_cm3_at_0", report.calibration.offset},
          {"density_g_cm3_per_unit", report.calibration.slope},
          {"rim_mm", vec_json(body.rim)},
          {"bins", body.elements.materials.size()},
          {"share_below_density_min", report.share_below_min},
          {"share_above_density_max", report.share_above_max},
          {"share_outside_law", report.share_outside_law ? ordered_json(*report.share_outside_law)
                                                         : ordered_json(nullptr)},
          {"share_of_modulus_min", report.share_of_modulus_min}};
}

}  // namespace

nlohmann::ordered_json body_json(const BodyOutput& body) {
  const MeshedBody& facts = body.facts;
  ordered_json json{{"element", body.elements.mid_nodes.empty() ? "tet4" : "tet10"},
                    {"element_size_mm", facts.element_size},
                    {"tolerance_mm", body.tolerance},
                    {"elements", body.elements.cells.size()},
                    {"nodes", body.elements.points.size()}};
  json.update(quality_json(facts.quality));
  json["components"] = facts.parts;
  json["components_dropped"] = facts.parts_dropped;
  json["fit"] = fit_json(facts);
  json["straight_skin_edges"] = facts.middles.straight;
  json["parts"] = parts_json(body.elements);
  json["sets"] = sets_json(body.elements);
  json["material"] = material_json(body);
  const std::string missed = unmet(body);
  json["kept"] = missed.empty();
  json["unmet"] = missed;
  json["seconds"] = facts.seconds.total;
  return json;
}

}  // namespace mesamis::detail::report
