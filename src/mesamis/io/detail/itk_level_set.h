// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/progress.h"
#include "mesamis/image/volume.h"

/// ITK's filters on volumes, in the grid's own axes. A voxel, as a length, is its shortest side.
/// Two sources have these functions: one over ITK, and one that refuses, for a build without it.
namespace mesamis::detail {

bool have_itk();

/// Curvature-driven anisotropic diffusion.
Volume diffused(const Volume& volume, int steps, double conductance, const Progress& progress);

/// Norm of the gradient of the image convolved with a Gaussian, native units per mm.
/// @param sigma  mm.
Volume gradient_magnitude(const Volume& volume, double sigma);

/// Distance in voxels from the surface at the level, positive above; cut off at +-band.
Volume signed_distance(const Volume& volume, double level, double band);

struct Evolution {
  double propagation, curvature, advection;
  int iterations;
  double rms_change;  ///< ends when the contour has moved less in 20 iterations, rms, voxels
};
struct EvolutionEnd {
  Volume level_set;
  int iterations;
  double rms_change;  ///< in the last 20 iterations, or as many as there were since the last look
  bool converged;
};
/// @param start  positive inside.
/// @param speed  0 to 1, the same grid.
EvolutionEnd evolved(const Volume& start, const Volume& speed, const Evolution& evolution,
                     const Progress& progress);

}  // namespace mesamis::detail
