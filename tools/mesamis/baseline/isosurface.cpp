// SPDX-License-Identifier: Apache-2.0
#include "mesamis/baseline/isosurface.h"

#include <string>

#include "mesamis/base/error.h"
#include "mesamis/baseline/vtk_isosurface.h"

namespace mesamis {

bool has_isosurface() { return have_vtk(); }

void require_valid(const IsosurfaceOptions& options) {
  constexpr double kMost = 100;  // voxels, as of gaussian_smoothed()
  if (!(options.smooth_voxels >= 0 && options.smooth_voxels <= kMost)) {
    throw InputError("smooth: expected 0 to 100 voxels, found " +
                     std::to_string(options.smooth_voxels));
  }
}

TriMesh isosurface(const Volume& volume, double level, const IsosurfaceOptions& options) {
  require_valid(options);
  return vtk_isosurface(volume, level, options);
}

}  // namespace mesamis
