// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/rooms.h"

namespace mesamis::detail::object {

/// Where a level comes from.
enum class LevelSource {
  kRun,     ///< measured in the image of the object
  kUser,    ///< given
  kScan,    ///< measured in the whole scan
  kCrop,    ///< measured in the cropped scan
  kTissue,  ///< an end of the tissue's range, or where its search starts
  kLabels   ///< half way between the voxels of labels and the others
};

/// A level that a run need not look for in its image.
struct KnownLevel {
  double value = 0;  ///< units of the image
  LevelSource from = LevelSource::kUser;
  double uncertainty = 0;  ///< native units, see HalfMaximumLevel; 0: not known
};

}  // namespace mesamis::detail::object
