// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "mesamis/base/progress.h"
#include "mesamis/image/volume.h"

namespace mesamis {

/// A voxel, as a length, is here the shortest of its sides, and the weights count against each
/// other alone: the same options serve any scan, whatever its resolution and grey values.
struct GeodesicOptions {
  double smooth_voxels = 0.5;  ///< Gaussian first: standard deviation, voxels of each axis; 0: none
  int diffusions = 0;          ///< steps of curvature-driven diffusion then; 0: none
  double conductance = 1;  ///< of the diffusion: the greater, the steeper an edge it flattens; > 0
  double sigma = 0.7;      ///< of the Gaussian within the gradient, voxels; 0.1 to 100
  std::optional<double> alpha = {};  ///< sigmoid's width, native units per mm, < 0; default: chosen
  std::optional<double> beta = {};   ///< its middle, native units per mm, > 0; default: chosen
  double shrink = 0;  ///< how far inside the level's surface the contour starts, voxels; -4 to 4
  double propagation = 0.05;  ///< weight of growth, 0 to 1e6
  double curvature = 0.05;    ///< weight of straightening, 0 to 1e6
  double advection = 1;       ///< weight of the pull towards edges, 0 to 1e6
  int iterations = 1000;      ///< at most, >= 1
  double rms_change = 0.03;   ///< at rest: 20 iterations move the contour less, rms, voxels; > 0
};

/// @throws InputError  naming the first option out of range.
void require_valid(const GeodesicOptions& options);

struct GeodesicReport {
  double edge_gradient = 0;  ///< a tenth of the surface at the level has less, native units per mm
  double flat_gradient = 0;  ///< median away from that surface, native units per mm
  double alpha = 0, beta = 0;  ///< of the sigmoid, as used, native units per mm
  int iterations = 0;          ///< done
  double rms_change = 0;       ///< of the last 20 iterations, voxels
  bool converged = false;      ///< came to rest before the iterations were used up
};

struct GeodesicContour {
  Volume level_set;  ///< the scan's grid; positive inside the contour, 0 on it, about the distance
                     ///< in voxels near it, constant farther away: isosurface(level_set, 0)
  GeodesicReport report;
};

/// Whether geodesic_contour() can be had: the library was built with ITK.
bool has_geodesic_contour();

/// What is used today, for comparison: a geodesic active contour (Caselles, Kimmel, Sapiro:
/// Geodesic active contours, IJCV 22(1), 1997), the method of ITK-SNAP, by ITK's filters. The
/// denoised image's gradient magnitude m makes the speed g = 1 / (1 + exp(-(m - beta) / alpha)), 0
/// at edges and 1 elsewhere, and the contour phi = 0, at first the surface at the level, follows
///
///   phi_t = g (propagation + curvature div n) |grad phi| + advection grad g . grad phi
///
/// (phi > 0 inside, n = grad phi / |grad phi|) until it rests. Where not given, beta is midway
/// between the gradients of weak edges and of no edges, and alpha a sixth of their difference, as
/// ITK's guide has it.
///
/// @param volume  as require_usable() wants it, at least 4 voxels per direction; the object is the
///                brighter part.
/// @param level   native units: where the surface is about.
/// @return the same bits for any number of threads.
/// @throws InputError  if an option or the volume is out of range, nothing crosses the level, the
///                     object shrinks to nothing or fills the volume, edges are no steeper than the
///                     rest while alpha or beta is to be chosen, or the library has no ITK.
/// @throws Cancelled   if progress says so.
///
/// O(voxels), and per iteration O(voxels at the contour); about 70 bytes per voxel.
GeodesicContour geodesic_contour(const Volume& volume, double level,
                                 const GeodesicOptions& options = {},
                                 const Progress& progress = {});

}  // namespace mesamis
