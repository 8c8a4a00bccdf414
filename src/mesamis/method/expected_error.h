// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/image/spline_image.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::method {

/// What expected_error() has to know of a scan.
struct ErrorOptions {
  /// Of means of the image along a surface across each axis, standard deviation, grey values, >= 0.
  std::array<double, 3> noise{};
  double contrast = 0;           ///< of the object, grey values, >= 0
  double level = 0;              ///< uncertainty of the object's level, grey values, >= 0
  std::array<double, 3> blur{};  ///< of the scan before it was undone, voxels, >= 0
  double decimated = 0;          ///< greatest distance by which decimation moved it, mm, >= 0
};

/// Estimates how far a surface lies from the truth, at each of its points.
///
/// With the slope of the image at the point, grey values per voxel, four things move the surface,
/// in voxels: the noise that is left in means along it, N = noise / slope, where the squares of the
/// normal's components weigh the axes; the level's uncertainty, U = level / slope; the blur at
/// bends, s^2 K, for the blur s and the curvature K of the image's level set; and edges that show
/// less of the object's contrast the larger the blur, L = contrast / slope. The mean distance
/// expected is
///   e^2 = (0.8 N)^2 + U^2 + (0.12 s^2 K)^2 + (0.02 s^2 L)^2,
/// no more than two voxels. 0.8 is the mean size of a normal variable; the factors of the blur are
/// fitted to distances measured on phantoms and simulated CT (docs/accuracy.md). Decimation adds the
/// square of a quarter of its greatest distance. Where the image's box cuts the object there is no
/// edge that could be off: 0. Walls and gaps that the surface has missed are not seen, nor is a
/// level that was chosen for another tissue.
/// @param surface  n points, world frame, mm.
/// @param image    the restored image, grey values.
/// @return n values, mm.
/// @throws InputError  as require_sound().
std::vector<double> expected_error(const TriMesh& surface, const SplineImage& image,
                                   const ErrorOptions& options);

/// The expected error of a surface as a whole; mm.
struct ErrorSummary {
  double mean = 0;          ///< over the area
  double percentile95 = 0;  ///< of the distances expected: 95 % of the area should be nearer
  double most = 0;          ///< of any triangle
  double area = 0;          ///< of the triangles that count, mm^2
  /// Whether any triangle counts.
  bool is_known() const noexcept { return area > 0; }
};

/// Summarizes mean distances expected at the points of a surface over its area, without the triangles
/// whose values are all 0. Distances are those of normal variables around 0: one of mean size e is
/// less than x with the probability erf(x / (e sqrt(pi))).
/// @param values  n, one per point, mm.
/// @return zeros, which are not known, if nothing is left.
/// @throws InputError  as require_sound().
///
/// O(n log n).
ErrorSummary summarize_error(const TriMesh& surface, const std::vector<double>& values);

}  // namespace mesamis::detail::method
