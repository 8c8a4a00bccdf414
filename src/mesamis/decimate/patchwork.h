// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/decimate/decimate_pass.h"

namespace mesamis::detail::decimate {

/// What a cover made of patches has taken.
struct PatchworkReport {
  int rounds = 0;             ///< in which patches were made anew because they met
  double to_originals = 0;    ///< of the result at most, see Cover, mm
  double from_originals = 0;  ///< no original was farther from the triangles that stand for it, mm
};

/// Decimates patches of one cover, in threads, and joins them. Patches do not see each other: those
/// that have come to intersect are made anew, with more points held; in the end they stay as they
/// were.
/// @param task     its progress is called from several threads, but never by two at once.
/// @param points   of the cover, mm; those of no patch stay.
/// @param patches  of cut_into_patches().
/// @param report   is added to.
/// @return over these points. The same for any number of threads.
/// @throws what the task's progress throws.
///
/// As decimate().
Cover decimate_patchwork(const DecimateTask& task, std::vector<Vec3> points,
                         std::vector<Patch> patches, PatchworkReport& report);

}  // namespace mesamis::detail::decimate
