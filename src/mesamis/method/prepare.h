// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/image/spline_image.h"
#include "mesamis/image/volume.h"
#include "mesamis/method/choose.h"
#include "mesamis/method/measured_image.h"
#include "mesamis/method/parameters.h"

namespace mesamis::detail::method {

/// The image as the method works on it, and what was chosen for the run.
struct Prepared {
  Parameters parameters;
  MeasuredImage measured;
  Volume grey;  ///< the volume, restored, in grey values
  /// The same between the voxels: the spline through what the bounds have not cut yet.
  SplineImage image;
  /// What was taken off both where each place has a level of its own, native units; no samples where
  /// there is one level.
  Volume excess{};
};

/// Counts the nodes of the first grid along each axis: every stride-th voxel, at least two.
/// @param voxels  at least 1 along each axis.
/// @param stride  voxels, at least 1.
std::array<Index, 3> first_grid_size(const std::array<Index, 3>& voxels,
                                     const std::array<Index, 3>& stride);

/// Chooses what the settings leave open from the volume, see choose(), restores it, and maps it to
/// grey values.
/// @param volume    native units, see require_usable().
/// @param settings  valid, see require_valid().
/// @throws InputError  as choose().
///
/// O(voxels); two copies of the samples at a time.
Prepared prepare_image(const VolumeView& volume, const ImageSettings& settings);

/// Prepares some slices of a scan as prepare_image() would with this choice.
/// @param slab    native units. The outer slices lack neighbours: twelve of them are not as they
///                would be in the whole.
/// @param excess  of choose_from_part(), of these slices; no samples: there is one level.
/// @param choice  of choose_from_part().
/// @return parameters and measured values as chosen; image and grey of the slab.
///
/// As prepare_image().
Prepared prepare_slab(const VolumeView& slab, const VolumeView& excess, const Chosen& choice);

/// How many cells the surface of a prepared slab asks for, see cells_of_image(). No unit.
double cells_of(const Prepared& slab);

}  // namespace mesamis::detail::method
