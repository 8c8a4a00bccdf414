// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/image/spline_image.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::method {

/// What expected_error() has to know of a scan.
struct ErrorOptions {
  double noise = 0;              ///< left in the image, standard deviation, grey values, >= 0
  double contrast = 0;           ///< of the object, grey values, >= 0
  std::array<double, 3> blur{};  ///< of the scan before it was undone, voxels, >= 0
  double decimated = 0;          ///< greatest distance by which decimation moved it, mm, >= 0
};

/// Estimates how far a surface lies from the truth, at each of its points.
///
/// With the slope of the image at the point, grey values per voxel, four things move the surface,
/// in voxels: the noise, N = noise / slope; the blur at bends, s^2 K, for the blur s and the
/// curvature K of the image's level set; and a level that is slightly off, L = contrast / slope,
/// more so the larger the blur. The mean distance expected is
///   e^2 = (0.67 N)^2 + (0.18 s^2 K)^2 + (0.018 s^2 L)^2 + (0.0085 L)^2,
/// no more than two voxels. The factors are least squares over the distances measured on phantoms
/// and simulated CT (docs/accuracy.md). Decimation adds the square of a quarter of its greatest
/// distance. Where the image's box cuts the object there is no edge that could be off: 0. Walls and
/// gaps that the surface has missed are not seen, nor is a level that was chosen for another
/// tissue.
/// @param surface  n points, world frame, mm.
/// @param image    the restored image, grey values.
/// @return n values, mm.
/// @throws InputError  as require_sound().
std::vector<double> expected_error(const TriMesh& surface, const SplineImage& image,
                                   const ErrorOptions& options);

/// The expected error of a surface as a whole; mm.
struct ErrorSummary {
  double mean = 0;          ///< over the area
  double percentile95 = 0;  ///< nineteen twentieths of the area have less
  double most = 0;          ///< of any triangle
  double area = 0;          ///< of the triangles that count, mm^2
};

/// Summarizes values on the points of a surface over its area, without the triangles whose values
/// are all 0.
/// @param values  n, one per point, mm.
/// @return zeros if nothing is left.
/// @throws InputError  as require_sound().
///
/// O(n log n).
ErrorSummary summarize_error(const TriMesh& surface, const std::vector<double>& values);

}  // namespace mesamis::detail::method
