// SPDX-License-Identifier: Apache-2.0
#include "costs.h"

#include <nlohmann/json.hpp>

#include "process.h"

namespace mesamis {

void add_costs(nlohmann::ordered_json& report) {
  report["seconds"] = wall_seconds();
  report["peak_memory_mb"] = peak_memory_mb();
}

}  // namespace mesamis
