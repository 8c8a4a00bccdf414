// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "mesamis/image/edge_sides.h"
#include "mesamis/image/volume.h"

namespace mesamis {

/// What is known of a scan; what is not is measured.
struct RestoreOptions {
  /// Native units, >= 0; see measure_noise().
  std::optional<double> noise = std::nullopt;
  /// Voxels, 0 to kLargestBlur; see measure_blur().
  std::optional<std::array<double, 3>> blur = std::nullopt;
};

/// The scan with its faults undone, as far as they can be.
struct Restored {
  Volume volume;                 ///< native units
  double noise = 0;              ///< of the scan, native units
  double noise_left = 0;         ///< of the volume here
  std::array<double, 3> blur{};  ///< of the scan, voxels
  double impulses = 0;           ///< share of the voxels that were replaced, 0 to 1
};

/// Measures noise, impulses and blur near the object's surface, removes the impulses and undoes the
/// blur, the more gently the larger the noise is against the object's contrast.
/// @param object  of this volume.
/// @throws InputError  if an option is out of range.
Restored restore(Volume volume, const ObjectEdges& object, const RestoreOptions& options = {});

}  // namespace mesamis
