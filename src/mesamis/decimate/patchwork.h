// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/decimate/decimate_patch.h"

namespace mesamis {

/// What a cover made of patches has taken.
struct PatchworkReport {
  int passes = 0;                ///< over one patch, at most
  std::int64_t points_held = 0;  ///< to keep distances within the tolerance
  int rounds = 0;                ///< in which patches were made anew because they met
  double drift = 0;              ///< of the result at most, see Cover, mm
};

/// Decimates patches of one cover, in threads, and joins them. Patches do not see each other: those
/// that have come to intersect are made anew, with more points held; in the end they stay as they
/// were.
/// @param task     its progress is called from several threads, but never by two at once.
/// @param patches  of cut_into_patches(). One alone works in all threads.
/// @param report   is added to.
/// @return over the points of the original. The same for any number of threads.
/// @throws what the task's progress throws.
///
/// As decimate().
Cover decimate_patchwork(const DecimateTask& task, std::vector<Patch> patches,
                         PatchworkReport& report);

}  // namespace mesamis
