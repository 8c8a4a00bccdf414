// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/grey_values.h"
#include "mesamis/image/volume.h"
#include "mesamis/settings.h"

namespace mesamis {

/// The image as the method works on it, and what was chosen for it.
struct Prepared {
  Settings settings;            ///< every default filled in but the level's
  double unit_mm = 1;           ///< the length unit
  GreyMap map;                  ///< native units to grey values, with T
  bool threshold_used = false;  ///< whether T acts, see (13)
  double level_native = 0;      ///< the level asked for, or a first guess of it
  double noise_left = 0;        ///< in the image below, native units
  double impulses = 0;          ///< share of the voxels that were replaced
  Volume grey;                  ///< the volume without its faults, in grey values
};

/// Nodes of the first grid: every stride-th voxel, at least two along each axis.
std::array<Index, 3> first_grid_size(const std::array<Index, 3>& voxels,
                                     const std::array<Index, 3>& stride);

/// Chooses what the settings leave open from the volume, and maps it to grey values.
/// @param settings  valid, see require_valid().
/// @throws InputError  if the window holds none of the samples, or does not hold the level.
Prepared prepare_image(const Volume& volume, const Settings& settings);

}  // namespace mesamis
