// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/method/measured_image.h"
#include "mesamis/method/parameters.h"
#include "mesamis/method/settings.h"
#include "mesamis/object/known_level.h"
#include "mesamis/object/mirror.h"
#include "mesamis/restore/half_maximum_level.h"
#include "mesamis/restore/restore.h"

/// Every choice of a run is made here: window, threshold, noise, blur, level, price of edges, cells
/// and tolerance. Other rooms measure; nothing else decides.
namespace mesamis::detail::method {

/// What a user asks of a run on an image.
struct ImageSettings {
  Settings asked{};                   ///< units of the image
  std::optional<KnownLevel> level{};  ///< of the object as a whole; nothing: that of its edge
  std::optional<ScanMeasure> scan{};  ///< of the scan that the image is a part of
  ImageUnits units{};                 ///< to those of the scan, for messages

  ImageSettings() = default;
  /// The level, if any, is the user's.
  ImageSettings(const Settings& settings)  // NOLINT(google-explicit-constructor)
      : asked(settings) {
    if (asked.level) level = KnownLevel{*asked.level};
  }
  /// A level that was found beforehand comes before the user's.
  ImageSettings(const Settings& settings, const std::optional<KnownLevel>& found)
      : asked(settings), level(found) {}
};

/// What a run uses.
struct Chosen {
  Parameters parameters;
  MeasuredImage measured;
  HalfMaximumLevel object;    ///< at whose surface the image is restored, native units
  double impulse_height = 0;  ///< see RestoreOptions
};

/// What a run uses, and the image that it was chosen from.
struct ChosenImage {
  Chosen chosen;
  Volume restored;  ///< native units; its edges are at one level
  /// Of the level of each place over the object's, native units, that was taken off; no samples:
  /// there is one level.
  Volume excess{};
};

/// Chooses what the settings leave open from an image: all but the tolerance.
///
/// The order is that of need: the object's edges give the window, the clamped image the level, its
/// noise and blur, the restored image the price of edges and the number of cells.
/// @param image     native units, see require_usable().
/// @param settings  valid, see require_valid().
/// @throws InputError  if the window holds none of the samples, or does not hold the level; for a
///                     solid, if its level is not between the least and the greatest sample (which
///                     is checked first), or is to be found and nothing stands out from the noise.
///
/// O(voxels); two copies of the samples at a time.
ChosenImage choose(const VolumeView& image, const ImageSettings& settings);

/// Chooses from a part of an image as choose() does; the number of cells stays open too.
/// @param part      native units, see require_usable().
/// @param whole     the image that it is a part of: the sizes that follow from a grid are its own.
/// @param settings  valid.
/// @throws InputError  as choose(). Cost as there.
ChosenImage choose_from_part(const VolumeView& part, const VoxelGrid& whole,
                             const ImageSettings& settings);

/// The level of an object in an image, and what noise is there; in the image's unit.
struct LevelInNoise {
  double level = 0;
  double contrast = 0;  ///< of the object
  double noise = 0;     ///< standard deviation, >= 0
};

/// Counts the cells that the surface in an image asks for, see cells_for_surface(). Where the noise
/// would make surface of its own, the image is smoothed before, and nothing thin can be told from
/// noise.
/// @param image     any unit, restored; a part counts its own surface.
/// @param accuracy  mm, see cells_for_surface().
/// @return no unit.
///
/// O(voxels); a smoothed copy where there is noise.
double cells_of_image(const VolumeView& image, const LevelInNoise& object, double accuracy);

/// Chooses the number of cells where it is open, between kFewestTets and kMostTets. A preview makes
/// none.
/// @param cells  that the surface asks for, see cells_for_surface().
/// @param slabs  that the scan is cut into, >= 1: each may have as many as a run without slabs.
void choose_max_tets(Parameters& parameters, double cells, Index slabs = 1);

/// The tolerance over the error to expect. What simplify() takes of an object costs about nothing at
/// five times; labels keep to half of that, slabs, which decimate() alone, to about a third. A
/// preview is shown, not printed: nothing is decimated.
inline constexpr double kErrorsOfObject = 5, kErrorsOfLabels = 2.5, kErrorsOfDecimation = 1.75,
                        kErrorsOfPreview = 0;

/// Chooses the tolerance where it is open: infinite where a number of triangles is asked for; half
/// of the accuracy, if that is asked for, but no less than 0.01 voxel; else how far the shape is
/// expected to be from the truth, but no less than 0.0168 and no more than 0.056 voxel, times so many
/// errors: a surface that is kept closer keeps detail smaller than its error.
/// @param voxel           geometric mean of the spacing, mm, > 0.
/// @param expected_error  in the mean over the surface, see expected_shape_error(), mm, >= 0.
/// @param errors          how many it may lose; 0: nothing is decimated.
void choose_tolerance(Parameters& parameters, double voxel, double expected_error, double errors);

}  // namespace mesamis::detail::method
