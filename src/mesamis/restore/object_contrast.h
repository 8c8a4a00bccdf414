// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/restore/level_crossings.h"

/// What an object's values are on the two sides of its surface.
namespace mesamis::detail::restore {

/// The values of an object and of the background at its surface.
struct ObjectContrast {
  double background = 0, object = 0;  ///< medians outside and inside of the surface, native units
  std::size_t samples = 0;            ///< points that counted on either side, in all

  /// Midway between background and object, native units.
  double half_maximum() const noexcept { return (background + object) / 2; }
  /// Object less background, native units.
  double difference() const noexcept { return object - background; }
};

/// Finds the place at a distance from a point of the surface along its normal, if the way to it
/// stays on one side of the surface.
/// @param guide   the image that is looked at on the way: it must stay on that side of the level.
/// @param point   with a normal.
/// @param voxels  distance, -2.5 to 2.5; outwards if positive, inwards if negative.
/// @param level   native units.
/// @return in the grid's own axes, mm; nothing if the guide crosses the level on the way (looked at
///         after 0.75, 1.5 and 2.5 voxels), or the image ends before.
std::optional<Vec3> place_along_normal(const VolumeView& guide, const SurfacePoint& point,
                                       double voxels, double level);

/// Measures the contrast at an object's surface: medians of the image one and a half voxels outside
/// and inside of the points. That is beyond most of the blur and not yet in the next tissue; what
/// blur is left pulls both medians alike. A point counts on a side only if the guide stays on that
/// side of the level up to there, so that thin walls, clefts and specks of noise do not shift the
/// medians.
/// @param volume  native values.
/// @param guide   the same image, smoothed or not, on the same grid.
/// @param points  of the surface {guide = level}; those without a normal are left out.
/// @param level   native units.
/// @return nothing if fewer than ten points count on a side.
std::optional<ObjectContrast> measure_contrast(const VolumeView& volume, const VolumeView& guide,
                                               const std::vector<SurfacePoint>& points,
                                               double level);

}  // namespace mesamis::detail::restore
