// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "mesamis/rooms.h"

namespace mesamis::detail::method {

/// What was found out about a scan beside the parameters that follow from it.
struct MeasuredImage {
  double noise_left = 0;  ///< standard deviation after restoring, native units
  std::array<double, 3>
      noise_correlation{};  ///< of neighbours in the scan, along each axis, -1 to 1
  std::array<double, 3>
      surface_noise{};  ///< of means along a surface across each axis, see Restored; native units
  double impulses = 0;  ///< share of the voxels that were replaced, 0 to 1
  double contrast = 0;  ///< of the object, native units; not positive: none was found
  double level_uncertainty = 0;  ///< see HalfMaximumLevel, native units; 0: not known
  /// Of levels for each place, see LocalLevel::range, native units; both 0: there is one level.
  std::array<double, 2> level_range{};
  /// Sheets that close tunnels through thin walls, see TunnelLift.
  std::int64_t closed_tunnels = 0;

  /// Whether places differ in their level.
  bool has_local_levels() const { return level_range[0] != level_range[1]; }
};

}  // namespace mesamis::detail::method
