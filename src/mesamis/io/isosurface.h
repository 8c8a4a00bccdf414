// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "mesamis/image/volume.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

struct IsosurfaceOptions {
  double smooth_voxels = 0;   ///< standard deviation of a Gaussian applied first, voxels; 0: none
  std::size_t triangles = 0;  ///< decimate by quadrics to about this many; 0: all of them
  bool close_at_box = false;  ///< caps where the object leaves the volume
};

/// What is used today, for comparison: the isosurface of the voxels (VTK's flying edges, which
/// gives marching cubes' triangles), optionally after smoothing and with quadric decimation.
///
/// @param level  native units.
/// @return LPS mm; oriented outward where the object is brighter; open where it leaves the volume,
/// unless
///         that is closed.
/// @throws InputError  if a parameter is negative or nothing crosses the level.
TriMesh isosurface(const Volume& volume, double level, const IsosurfaceOptions& options = {});

}  // namespace mesamis
