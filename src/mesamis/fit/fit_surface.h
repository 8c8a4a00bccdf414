// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/fit/bending.h"
#include "mesamis/fit/image_edge.h"
#include "mesamis/image/spline_image.h"
#include "mesamis/surface/tri_mesh.h"

/// Surfaces that are fitted to an image, as smooth as they can be.
namespace mesamis::detail::fit {

/// How a surface is fitted.
struct FitOptions {
  double reach = 1.6;   ///< voxels, > 0: how far from a point an edge of the image is looked for
  double bending = 40;  ///< weight of even shifts against a steep edge of the image, > 0
  double start = 0.1;   ///< weight of the place where a point was, against the same, > 0
  int rounds = 6;       ///< of looking for edges and solving, at least 1
  SheetLevel sheets{};  ///< of the image
};

/// What is known of the points of a surface that is to be fitted; one entry each per point.
struct FitPoints {
  /// Of the image at the edge that a point belongs to, grey values: of the side behind the surface
  /// above that in front; 0: the image shows no edge there.
  std::vector<double> contrast;
  std::vector<char> on_curve;  ///< 1 where several boundaries meet: there no edge is looked for
  Links links;                 ///< between Neighbors of the surface
};

/// Fits a smooth surface to the edges of an image.
///
/// In each round every point looks along its normal for an edge: at x_edge, with the weight w, 0
/// where there is none and 1 where it is steep. Then all points move to the least of
///   sum of w |x - x_edge|^2 + (1 - w) start |s|^2 + bending |L s|^2,  s = x - x_start
/// with the umbrella operator L: the shifts are smooth, so that nothing shrinks. Where the image
/// shows an edge the surface lies on it; elsewhere it stays, or goes with what is beside it. Where
/// triangles meet, as where two boundaries see the same edge, points around look for none any more,
/// and rounds are added, in which others keep their edges. In the end moves that would still make
/// the surface meet itself, in the single precision of a file, are taken back. Points on the
/// image's box stay.
/// @param surface  smooth, see smooth_places(); in the image's own axes, mm; closed, or boundaries
///                 of several objects that share edges; without self-intersections.
/// @param image    in grey values.
/// @return the same triangles.
/// @throws InputError  as require_sound(), or if the points do not fit the surface.
///
/// O(n log n) for n points. The same bits for any number of threads.
TriMesh fit_surface(const TriMesh& surface, const SplineImage& image, const FitPoints& points,
                    const FitOptions& options);

}  // namespace mesamis::detail::fit
