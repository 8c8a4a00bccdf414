// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/method/settings.h"
#include "mesamis/report/body_output.h"
#include "mesamis/report/body_wishes.h"

namespace mesamis::detail::report {

/// What a body follows where nothing was asked for.
struct BodySource {
  const VoxelGrid& grid;              ///< of the scan
  std::optional<double> tolerance{};  ///< of the run's settings, mm; none, 0: none was given
  std::array<double, 3> blur{};       ///< of the scan, standard deviation along each axis, voxels
  double memory_gb = 0;               ///< that the body may take; 0: what is free
};

/// Checks that a run gives a surface that elements can fill, and a tolerance for their skin.
/// @param settings   of the run, as they were given.
/// @param tolerance  that was asked for, mm; none: that of the settings.
/// @throws InputError  for a band, and where neither is a tolerance; a preview needs none.
void require_fillable(const Settings& settings, std::optional<double> tolerance);

/// The request with what was left open: the skin's tolerance is that of the run's settings if one
/// was given, else a tenth of the element size; with a material the rim is as deep as the scan is
/// blurred; no more elements are made than fit into the memory.
/// @param wishes   see require_valid().
/// @param objects  that shall be filled.
/// @param source   tolerance in mm, memory in GB.
/// @throws InputError  as require_valid() and require_set_names(), or if a set names an object that
///                     is not there.
///
/// O(n log n) for n sets.
BodyRequest complete_request(const BodyWishes& wishes, std::span<const FoundObject> objects,
                             const BodySource& source);

/// A warning of parts that do not touch each other: they have to be held one by one, or a solver
/// finds no balance.
/// @param parts    connected by faces.
/// @param objects  that were filled.
/// @return empty if there are no more parts than objects.
std::string loose_parts(std::int64_t parts, std::int64_t objects);

}  // namespace mesamis::detail::report
