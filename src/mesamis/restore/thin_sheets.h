// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/restore/object_contrast.h"

namespace mesamis::detail::restore {

/// What lift_thin_sheets() has to know of a scan.
struct SheetOptions {
  ObjectContrast contrast;       ///< of thick parts, native units; a positive difference
  std::array<double, 3> blur{};  ///< of the scan, standard deviations, voxels, >= 0
  /// With which the blur was undone, see deblurred(); nothing: it was not.
  std::optional<double> regularization = std::nullopt;
  std::array<double, 3> undone{};  ///< deviations that were undone of it, voxels, 0 to blur
  double noise = 0;                ///< of the scan, standard deviation, native units, >= 0
};

/// Corrects a restored image where a sheet of the object (a thin wall) or a sheet of its background
/// (a gap) is so thin that the blur keeps it from reaching its own value.
///
/// A sheet of thickness t appears in an image of blur s with the peak 2 Phi(t / 2s) - 1 of the
/// contrast. Where the contrast of thick parts is known, the peak tells the thickness, also far
/// below the blur (Treece et al. 2010 use this for cortical bone), and the thickness tells the
/// value E(t) that the restored image has at the sheet's faces. What E(t) lacks of one half of the
/// contrast is added to the sheet, so that the level of half maximum runs along its faces. It is
/// negative for walls of some two voxels, whose faces the filter raises; gaps are never narrowed.
///
/// Where the restored image is lower in the middle of a wall than the model has it (bone that is
/// less dense, a wall that bends), E is lowered in proportion, and walls thinner than half a voxel
/// are drawn at half of their own peak: nearer to it, samples leave holes in them. What is added
/// for walls is the mean of what the voxels within some 1.5 voxels say, so that a wall is lifted as a
/// whole; what is taken off for gaps is each voxel's own.
///
/// A voxel belongs to a sheet if the smoothed scan, followed both ways along the main direction of
/// its gradients, has a maximum (or, for gaps, a minimum) and falls off again on both sides, and if
/// the gradients around agree in that direction. Peaks of less than 0.15 of the contrast, or that
/// noise may have made, are left alone.
/// @param restored  native units; changed in place.
/// @param guide     the scan as it came, smoothed() once, on the same grid, native units.
///
/// O(voxels); two splines and four copies of the samples. The same bits for any number of threads.
void lift_thin_sheets(Volume& restored, const VolumeView& guide, const SheetOptions& options);

}  // namespace mesamis::detail::restore
