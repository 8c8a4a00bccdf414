// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mesamis/shape_files/surface_pair.h"
#include "mesamis/surface/comparison.h"

namespace mesamis::detail::report {

/// Distances in one direction, mm: vertices, mean (15), rms, p95, p99, max, and the same by area.
///  O(n log n) for n distances.
nlohmann::ordered_json distances_json(const DirectedDistances& distances);

/// The same of distances that are summarised already.
nlohmann::ordered_json distances_json(const DirectedSummary& summary);

/// The distances (14)-(16) under the names of the paper, mm: its surface of vertices v is the
/// reference.
/// @param reference_to_surface  with one distance from a vertex at least.
///
/// O(n log n) for n distances.
nlohmann::ordered_json paper_distances_json(const DirectedDistances& reference_to_surface);

/// The entry "objects" of a report: of each its name and its distances in both directions.
nlohmann::ordered_json objects_json(const std::vector<ObjectDistances>& objects);

/// The entry "frames" of a report: the frames that the files state, and whether the surface was
/// turned.
nlohmann::ordered_json frames_json(const SurfacePair& pair);

}  // namespace mesamis::detail::report
