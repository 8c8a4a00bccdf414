// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/restore/half_maximum_level.h"
#include "mesamis/restore/object_edge.h"

namespace mesamis::detail::restore {

/// What is known of a scan's noise and blur; what is not known is measured.
struct RestoreOptions {
  /// Standard deviation, native units, >= 0; default: measure_noise().
  std::optional<double> noise = std::nullopt;
  /// Standard deviations along the axes, voxels, 0 to kLargestBlur; default: measure_blur().
  std::optional<std::array<double, 3>> blur = std::nullopt;
  /// The difference to its neighbours that makes a voxel an impulse, native units; 0: nothing does.
  /// Default: as noise and contrast have it, where so many are found that they are no structures.
  std::optional<double> impulse_height = std::nullopt;
};

/// What restoring a scan goes by.
struct ScanMeasure {
  SeenObject object;
  double noise = 0;                     ///< standard deviation, native units
  std::array<double, 3> blur{};         ///< standard deviations, voxels
  double impulse_height = 0;            ///< see RestoreOptions; 0 where there are none
  std::optional<double> level_share{};  ///< see LocalLevel::share; nothing: not measured

  /// To restore parts of the scan alike.
  RestoreOptions options() const { return {noise, blur, impulse_height}; }
};

/// Measures a scan, so that its parts can be restored alike.
/// @param object  of this scan, see see_object().
/// @return nothing where no object stands out from the noise.
///
/// O(voxels); two copies of the samples.
std::optional<ScanMeasure> measure_scan(const VolumeView& scan, const SeenObject& object);

/// A scan without its impulses and with its blur undone, as far as the noise permits.
struct Restored {
  Volume volume;     ///< native units
  double noise = 0;  ///< standard deviation in the scan, native units
  /// Of the noise between neighbours along each axis, see measure_noise_correlation().
  std::array<double, 3> noise_correlation{};
  double noise_left = 0;  ///< standard deviation in the volume here, native units
  /// Of means of the volume along a surface across each axis, see noise_gain_along_surface(): their
  /// standard deviation, native units.
  std::array<double, 3> surface_noise{};
  std::array<double, 3> blur{};  ///< standard deviations in the scan, voxels
  double impulses = 0;           ///< share of the voxels that were replaced, 0 to 1
  double impulse_height = 0;     ///< see RestoreOptions; 0 where none were replaced
};

/// Restores a scan: measures noise, impulses and blur near the object's surface, removes the
/// impulses (remove_impulses()) and undoes the blur (deblurred()), the more gently the larger the
/// noise is against the object's contrast. A blur of 0.35 voxels is left along each axis (in
/// squares): it is about what samples can show. What the blur still hides, walls and gaps thinner
/// than itself, is corrected (lift_thin_sheets()).
/// @param volume  native values; taken over, pass it with std::move() to save the copy.
/// @param object  of this volume, see find_object_edge(). Where its contrast is not positive, the
/// volume stays as it is, and its noise is that of all places.
/// @throws InputError  if an option is out of range.
/// O(voxels); about four copies of the samples.
Restored restore(Volume volume, const HalfMaximumLevel& object, const RestoreOptions& options = {});

}  // namespace mesamis::detail::restore
