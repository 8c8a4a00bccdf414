// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "mesamis/base/progress.h"
#include "mesamis/image/volume.h"

namespace mesamis {

/// Lengths in voxels are multiples of the shortest side of a voxel, and the weights count against
/// each other alone, so that the same options serve any resolution and any range of grey values.
struct GeodesicOptions {
  double smooth_voxels = 0.5;  ///< Gaussian applied first: standard deviation, voxels of each axis,
                               ///< 0 to 100; 0: none
  int diffusions = 0;          ///< steps of curvature-driven diffusion applied next, >= 0; 0: none
  double conductance = 1;      ///< of the diffusion, > 0; a larger one smooths steeper edges
  double sigma = 0.7;          ///< of the Gaussian derivative in the gradient, voxels, 0.1 to 100
  std::optional<double> alpha = {};  ///< width of the sigmoid, native units per mm, < 0; default:
                                     ///< chosen
  std::optional<double> beta = {};   ///< centre of the sigmoid, native units per mm, > 0; default:
                                     ///< chosen
  double shrink = 0;          ///< distance of the start inside the level's surface, voxels, -4 to 4
  double propagation = 0.05;  ///< weight of the growth, 0 to 1e6
  double curvature = 0.05;    ///< weight of the curvature, 0 to 1e6
  double advection = 1;       ///< weight of the attraction by edges, 0 to 1e6
  int iterations = 1000;      ///< at most, >= 1
  double rms_change = 0.03;   ///< convergence: rms change in 20 iterations below this, voxels, > 0
};

/// Checks that all options are in range.
/// @throws InputError  naming the first option that is not.
void require_valid(const GeodesicOptions& options);

/// What geodesic_contour() chose and how it ended.
struct GeodesicReport {
  double edge_gradient = 0;  ///< tenth percentile on the surface at the level, native units per mm
  double flat_gradient = 0;  ///< median 3 to 6 voxels away from that surface, native units per mm
  double alpha = 0, beta = 0;  ///< of the sigmoid, as used, native units per mm
  int iterations = 0;          ///< done
  double rms_change = 0;       ///< over the last 20 iterations, voxels
  bool converged = false;      ///< whether rms_change fell below its limit
};

struct GeodesicContour {
  Volume
      level_set;  ///< on the scan's grid; positive inside the contour, 0 on it; about the distance
                  ///< in voxels near it, constant elsewhere; its surface: isosurface(level_set, 0)
  GeodesicReport report;
};

/// Tells whether the library was built with ITK, which geodesic_contour() needs.
bool has_geodesic_contour();

/// Segments a scan by a geodesic active contour, the method of ITK-SNAP, to compare with.
///
/// The gradient magnitude m of the denoised image gives the speed
/// g = 1 / (1 + exp(-(m - beta) / alpha)), 0 at edges and 1 elsewhere. The contour phi = 0 starts
/// as the surface at the level and evolves by
///
///   phi_t = g (propagation + curvature div n) |grad phi| + advection grad g . grad phi
///
/// with phi > 0 inside and n = grad phi / |grad phi|, until it converges. Where not given, beta is
/// midway between report.flat_gradient and report.edge_gradient, and alpha is minus a sixth of
/// their difference, as ITK's guide recommends.
/// Source: Caselles, Kimmel, Sapiro: Geodesic active contours, IJCV 22(1), 1997.
///
/// No global setting of ITK is changed. The filters that ITK makes within its filters therefore use
/// ITK's default number of threads; all others use thread_count().
///
/// @param volume    as require_usable() wants it, at least 4 voxels per direction; the object is
///                  the brighter part.
/// @param level     native units; where the surface is about.
/// @param options   see there.
/// @param progress  called with the stages "denoise" (if options.diffusions > 0) and "evolve".
/// @return the level set and the report; not converged is no error. The same bits for any number of
///         threads.
/// @throws InputError      if an option or the volume is out of range, nothing crosses the level,
///                         the contour vanishes or fills the volume, edges are no steeper than
///                         the rest while alpha or beta is to be chosen, or the library has no ITK.
/// @throws NumericalError  if a filter of ITK fails.
/// @throws Cancelled       if progress says so.
///
/// O(voxels), and per iteration O(voxels at the contour); about 70 bytes per voxel.
GeodesicContour geodesic_contour(const Volume& volume, double level,
                                 const GeodesicOptions& options = {},
                                 const Progress& progress = {});

}  // namespace mesamis
