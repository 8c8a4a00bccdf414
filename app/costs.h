// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace mesamis {

/// Adds "seconds" and "peak_memory_mb" of the program so far to the end of a report.
void add_costs(nlohmann::ordered_json& report);

}  // namespace mesamis
