// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/image/spline_image.h"
#include "mesamis/image/volume.h"
#include "mesamis/method/measured_image.h"
#include "mesamis/method/parameters.h"
#include "mesamis/method/settings.h"
#include "mesamis/restore/half_maximum_level.h"
#include "mesamis/restore/surface_extent.h"

namespace mesamis {

/// The image as the method works on it, and what was chosen for the run.
struct Prepared {
  Parameters parameters;
  MeasuredImage measured;
  Volume grey;  ///< the volume, restored, in grey values
  /// The same between the voxels: the spline through what the bounds have not cut yet.
  SplineImage image;
  /// What was taken off both where each place has a level of its own, grey values; no samples where
  /// there is one level.
  Volume excess{};
};

/// What a run uses, chosen from a scan or from a part of it that stands for the whole.
struct ChosenParameters {
  Parameters parameters;  ///< max_tets counts the surface of the part
  MeasuredImage measured;
  HalfMaximumLevel object;    ///< at whose surface the image is restored, native units
  double impulse_height = 0;  ///< see RestoreOptions
};

/// Counts the nodes of the first grid along each axis: every stride-th voxel, at least two.
/// @param voxels  at least 1 along each axis.
/// @param stride  voxels, at least 1.
std::array<Index, 3> first_grid_size(const std::array<Index, 3>& voxels,
                                     const std::array<Index, 3>& stride);

/// Chooses what the settings leave open from the volume, restores it, and maps it to grey values.
///
/// The order is that of need: the object's edges give the window, the clamped image the level, its
/// noise and blur, the restored image the number of cells and the price of edges.
/// @param volume    native units, see require_usable().
/// @param settings  valid, see require_valid().
/// @throws InputError  if the window holds none of the samples, or does not hold the level; for a
///                     solid, if its level is not between the least and the greatest sample (which
///                     is checked first), or is to be found and nothing stands out of the noise.
///
/// O(voxels); two copies of the samples at a time.
Prepared prepare_image(const VolumeView& volume, const Settings& settings);

/// Chooses as prepare_image() does, and keeps nothing of the image.
/// @param part      native units, see require_usable().
/// @param whole     the scan that it is a part of: the sizes that follow from a grid are its own.
/// @param settings  valid.
/// @throws InputError  as prepare_image().
///
/// O(voxels of the part); two copies of its samples at a time.
ChosenParameters choose_parameters(const VolumeView& part, const VoxelGrid& whole,
                                   const Settings& settings);

/// Prepares some slices of a scan as prepare_image() would with this choice.
/// @param slab    native units. The outer slices lack neighbours: twelve of them are not as they
///                would be in the whole.
/// @param choice  of choose_parameters().
/// @return parameters and measured values as chosen; image and grey of the slab.
///
/// As choose_parameters().
Prepared prepare_slab(const VolumeView& slab, const ChosenParameters& choice);

/// How much surface at the level of a choice a prepared slab has; of its own grey values.
SurfaceExtent extent_of(const Prepared& slab);

}  // namespace mesamis
