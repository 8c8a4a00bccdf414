// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/decimate/collapse.h"

namespace mesamis::detail::decimate {

/// How far the triangles before and after a collapse lie apart at most, mm, along their common mean
/// normal: they have the same rim. Their distance is greatest where their edges cross, or at a point
/// within the rim. Infinity where either folds over itself in this view, and of an edge at a rim.
///
/// O(n^2) for n triangles.
double fan_height(const EditableSurface& surface, const std::vector<Vec3>& points,
                  const Collapse& collapse);

}  // namespace mesamis::detail::decimate
