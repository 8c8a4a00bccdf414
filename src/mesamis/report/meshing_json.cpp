// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/meshing_json.h"

#include <nlohmann/json.hpp>

namespace mesamis::detail::report {

nlohmann::ordered_json meshing_json(const MeshingQuality& quality) {
  return {{"least_angle_deg", quality.triangles.least_angle},
          {"share_above_30_deg", quality.triangles.share_above_30_deg},
          {"tolerance_mm", quality.tolerance},
          {"distance_meshing_to_printing_max", quality.to_given},
          {"distance_printing_to_meshing_max", quality.from_given},
          {"self_intersections", quality.self_intersections},
          {"kept", unmet(quality).empty()}};
}

}  // namespace mesamis::detail::report
