// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// The diagrams of a page, as SVG elements.
namespace mesamis::detail::page {

/// How many voxels of a scan have each value, on a logarithmic axis, with the window, the threshold
/// and the level of a report's run. Marks beyond single precision, which samples have, are left
/// out.
/// @param scan  usable, see require_usable().
std::string histogram_svg(const VolumeView& scan, const nlohmann::json& report);

/// The energy of each pass of a run and its parts; empty where the report has fewer than two
/// passes.
std::string energy_svg(const nlohmann::json& report);

/// The cells of each mesh of a run; empty as for energy_svg().
std::string cells_svg(const nlohmann::json& report);

/// How far each mesh moved the surface, and how far it may at the end; empty where that was not
/// measured.
std::string movement_svg(const nlohmann::json& report);

}  // namespace mesamis::detail::page
