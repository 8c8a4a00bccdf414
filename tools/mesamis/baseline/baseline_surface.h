// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "mesamis/base/progress.h"
#include "mesamis/baseline/geodesic_contour.h"
#include "mesamis/baseline/isosurface.h"
#include "mesamis/image/volume.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

enum class BaselineMethod {
  kIsosurface,  ///< of the voxels
  kGeodesic,    ///< of the level set of a geodesic active contour
};

struct BaselineOptions {
  BaselineMethod method = BaselineMethod::kIsosurface;
  std::optional<double> level =
      {};  ///< native units; default: midway, see find_half_maximum_level()
  IsosurfaceOptions isosurface = {};  ///< with kGeodesic smooth_voxels is not used
  GeodesicOptions geodesic = {};      ///< of kGeodesic alone
};

/// A surface to compare with.
struct BaselineSurface {
  double level = 0;                       ///< that was used, native units
  TriMesh surface;                        ///< LPS mm
  std::optional<GeodesicReport> contour;  ///< of kGeodesic
  double seconds = 0;                     ///< wall time of the method, from voxels to triangles

  /// False if the contour did not come to rest.
  bool converged() const { return !contour || contour->converged; }
};

/// Makes the surface of a scan by a method that is in use today: the isosurface at the level, or
/// the geodesic active contour that starts there.
/// @param volume    native units; as require_usable() wants it.
/// @param progress  optional; only the contour calls it.
/// @return the same bits for any number of threads, but for the seconds.
/// @throws InputError  as find_half_maximum_level(), isosurface() and geodesic_contour().
/// @throws Cancelled   if progress says stop.
///
/// Time and memory as isosurface() or geodesic_contour().
BaselineSurface make_baseline(const Volume& volume, const BaselineOptions& options = {},
                              const Progress& progress = {});

}  // namespace mesamis
