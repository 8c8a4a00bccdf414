// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/base/types.h"

namespace mesamis {

/// The height between two fans of triangles over one ring of points: (apex, ring[i], ring[i+1]),
/// and (ring[0], ring[i], ring[i+1]), which the collapse of the apex onto ring[0] puts in its
/// place.
///
/// Seen along the mean normal of the first fan, each point of one lies above one point of the
/// other. Their distance is greatest where edges cross, or at the apex.
/// @param apex  mm.
/// @param ring  at least three points, mm, in their order around the apex, seen from either side.
/// @return mm; infinity where one of the fans folds over itself in this view.
///
/// O(n^2) for n points.
double fan_distance(const Vec3& apex, std::span<const Vec3> ring);

}  // namespace mesamis
