// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "mesamis/method/label_surfaces.h"
#include "mesamis/report/verdict.h"

namespace mesamis::detail::report {

/// What a report says of a run on labels: settings, chosen, given, grey, object (its labels, margin,
/// surfaces, boundaries), quality, seconds_parts; docs/formats.md lists the keys.
/// @param asked   the settings the run was started with.
/// @param result  of find_labelled_objects() or surfaces_of_labels().
/// @param checks  of the surfaces of its objects, in their order.
///
/// O(points and triangles), up to a logarithm.
nlohmann::ordered_json label_run_json(const Settings& asked, const LabelResult& result,
                                      std::span<const SurfaceCheck> checks);

/// The settings that repeat a run on labels, or on several seeds: crop and level as they were asked
/// for, as the run looks around the labels alone, and each boundary has a level of its own.
Settings settings_used_by_labels(const Settings& asked, const Parameters& used);

/// Judges the surfaces of objects: each must be closed, 2-manifold, face outward, and be as accurate
/// as was asked for, and the flow of the labels must have converged.
/// @param checks  as for label_run_json().
Verdict judge(const LabelResult& result, std::span<const SurfaceCheck> checks);

}  // namespace mesamis::detail::report
