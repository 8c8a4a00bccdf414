// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "mesamis/decimate/interfaces.h"
#include "mesamis/decimate/patch.h"

namespace mesamis::detail::decimate {

/// The input that all passes of decimate() share.
struct DecimateTask {
  const TriMesh& surface;  ///< the original: a 2-manifold, closed or a part
  double tolerance;        ///< mm; infinity: none
  std::int64_t triangles;  ///< a pass stops at so many
  std::function<void(double)> progress;
  /// Of the surface, if it is a partition's; nullptr: none.
  const Interfaces* interfaces = nullptr;

  /// Of points that are copies of one, the first.
  Index first_copy(Index point) const { return interfaces ? interfaces->first_copy[point] : point; }
};

/// Makes one pass over a patch: collapses in the order of the quadrics while the guarantees of
/// decimate() hold.
/// @return over the points of the patch.
Cover decimate_pass(const DecimateTask& task, const Patch& patch);

}  // namespace mesamis::detail::decimate
