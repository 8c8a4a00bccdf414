// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "mesamis/image/volume.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

struct IsosurfaceOptions {
  double smooth_voxels = 0;   ///< Gaussian applied first: standard deviation, voxels of each axis,
                              ///< 0 to 100; 0: none
  std::size_t triangles = 0;  ///< decimate by quadrics to about this many; 0: keep all
  bool close_at_box = false;  ///< close the surface where the object leaves the volume
};

/// Checks options before any work.
/// @throws InputError  for a standard deviation that is not 0 to 100 voxels.
void require_valid(const IsosurfaceOptions& options);

/// Whether isosurface() can do anything: false where the program was built without VTK.
bool has_isosurface();

/// Extracts the isosurface of a volume, to compare with.
///
/// VTK's flying edges, which gives the triangles of marching cubes, optionally after smoothing and
/// before quadric decimation. No global setting of VTK is changed.
///
/// @param volume   at least 2 voxels per direction, finite samples.
/// @param level    native units.
/// @param options  see there.
/// @return triangles in LPS mm, oriented outward where the object is brighter. Open where the
///         object leaves the volume, unless options.close_at_box.
/// @throws InputError      if options.smooth_voxels is out of range, or no value of the (smoothed)
///                         volume is below or none is above the level.
/// @throws NumericalError  if a filter of VTK fails.
///
/// O(voxels + triangles log(triangles)); 4 bytes per voxel for each of smoothing and closing.
TriMesh isosurface(const Volume& volume, double level, const IsosurfaceOptions& options = {});

}  // namespace mesamis
