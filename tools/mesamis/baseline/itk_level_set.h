// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/progress.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// ITK's filters on volumes, in the axes of the grid. A length in voxels is a multiple of the
/// shortest side of a voxel. Two sources define these functions: one calls ITK, the other, for a
/// build without ITK, throws an InputError.
///
/// Each filter runs in thread_count() work units and gives the same bits for any number. The
/// filters that ITK makes within a filter follow ITK's global default, which is not changed here.
namespace mesamis::detail::baseline {

/// Whether the library was built with ITK.
bool have_itk();

/// Curvature-driven anisotropic diffusion.
/// @param steps        in time, of 1/16, >= 1.
/// @param conductance  > 0; edges that are steep against it are kept.
/// @throws Cancelled  if progress, called with the stage "denoise", says so.
Volume diffused(const Volume& volume, int steps, double conductance, const Progress& progress);

/// Norm of the gradient of the image convolved with a Gaussian, native units per mm.
/// @param volume  at least 4 voxels per direction.
/// @param sigma   mm, > 0.
Volume gradient_magnitude(const Volume& volume, double sigma);

/// Distance in voxels from the surface at the level, positive above the level, clamped to
/// [-band, band].
Volume signed_distance(const Volume& volume, double level, double band);

/// Weights and limits of an evolution, as in GeodesicOptions.
struct Evolution {
  double propagation, curvature, advection;
  int iterations;     ///< at most
  double rms_change;  ///< convergence: rms change of the contour over 20 iterations, voxels
};

struct EvolutionResult {
  Volume level_set;   ///< positive inside
  int iterations;     ///< done
  double rms_change;  ///< over the last 20 iterations, or those since the last multiple of 20
  bool converged;
};

/// Evolves the contour at 0 of a level set, see geodesic_contour().
/// @param start  positive inside; about the distance in voxels near its contour.
/// @param speed  0 to 1 on the same grid.
/// @throws Cancelled  if progress, called with the stage "evolve", says so.
EvolutionResult evolved(const Volume& start, const Volume& speed, const Evolution& evolution,
                        const Progress& progress);

}  // namespace mesamis::detail::baseline
