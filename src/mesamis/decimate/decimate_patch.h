// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/decimate/decimate_pass.h"

namespace mesamis {

/// A patch that has been decimated.
struct DecimatedPatch {
  Cover cover;                   ///< over the points of the patch
  int passes = 0;                ///< that it took
  std::int64_t points_held = 0;  ///< to keep distances within the tolerance
};

/// Decimates a patch within the tolerance of the originals that it stands for, which must be near
/// it before. Passes are repeated from the start, each with more points held, until no triangle is
/// too far; what cannot be decimated so stays as it was.
DecimatedPatch decimate_patch(const DecimateTask& task, const Patch& patch);

/// Holds points of a patch, the corners of the triangles that stand for any of these originals, and
/// so many rings of points around all these.
/// @param points     of the patch, in any order.
/// @param originals  increasing.
void hold(Patch& patch, const std::vector<Index>& points, const std::vector<Index>& originals,
          int rings);

}  // namespace mesamis
