// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "mesamis/image/volume.h"
#include "mesamis/object/object_request.h"
#include "mesamis/rooms.h"

/// Tissues by their values in CT: what is meant by "bone" or "airway".
namespace mesamis::detail::object {

/// The presets, in the order in which help lists them: bone, teeth, soft, skin, lung, airway,
/// vessel, dark.
std::span<const Tissue> tissue_table() noexcept;

/// Suggests the tissue that a user of this scan most likely means.
/// @param volume  at least one sample, all finite.
/// @return bone for CT with at least a thousandth of the voxels above 200 HU, skin for other CT,
///         nothing for other scans.
std::optional<Tissue> suggested_tissue(const VolumeView& volume);

/// Names the tissue that a level shows the surface of, for a word in a report.
/// @param volume  at least one sample, all finite.
/// @param level   native units.
/// @return "skin", "soft tissue", "vessels or spongy bone", "bone" or "metal"; empty if the scan is
///         not CT, or nothing crosses the level.
std::string surface_at_level(const VolumeView& volume, double level);

}  // namespace mesamis::detail::object
