// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mesamis/image/volume.h"

/// What lies on the two sides of an object's surface, measured in the native image.
namespace mesamis {

/// A point of a surface and its unit normal, pointing out of the (brighter) object.
struct SurfacePoint {
  Vec3 position;  ///< in the grid's own axes, mm
  Vec3 normal;
};

struct EdgeSides {
  double outside = 0, inside = 0;  ///< medians, native units
  std::size_t samples = 0;         ///< points that counted on both sides, together
  double middle() const { return (outside + inside) / 2; }
  double contrast() const { return inside - outside; }
};

/// The place so many voxels off an edge's point along its normal, outwards, or inwards if negative.
/// @param guide   what is asked on the way: it must stay on that side of the level.
/// @param voxels  up to 2.5.
/// @return nothing if the guide does not, or its box ends before.
std::optional<Vec3> place_beside(const Volume& guide, const SurfacePoint& point, double voxels,
                                 double level);

/// Medians of the image one and a half voxels outside and inside of the points: beyond most of
/// the blur, not yet in the next tissue. What blur is left pulls both sides alike. A point counts
/// on a side only if the guide stays on that side of the level up to there, so that thin walls,
/// clefts and the specks of noise do not drag the medians.
/// @param volume  native values, as they are.
/// @param guide   the same, smoothed or not.
/// @return nothing if fewer than ten points count on a side.
std::optional<EdgeSides> measure_sides(const Volume& volume, const Volume& guide,
                                       const std::vector<SurfacePoint>& points, double level);

/// Where a volume's grid lines cross a level, with normals from its gradient; evenly thinned out
/// to about `most` points.
std::vector<SurfacePoint> crossing_points(const Volume& volume, double level, std::size_t most);

/// A first guess of the object's edges, from the image alone.
struct ObjectEdges {
  EdgeSides sides;
  double level = 0;  ///< midway between the two sides
  double area = 0;   ///< of the smoothed image's level set, mm^2: the extent of the edges
};

struct FindObjectOptions {
  /// Level whose area is measured; default: the one found.
  std::optional<double> area_at = std::nullopt;
  /// Level to settle from; default: as described below.
  std::optional<double> start = std::nullopt;
};

/// Finds the bright object: CT from its crossings of 200 HU (bone), other images from Otsu's
/// threshold, of all voxels or, where that splits nothing but noise, of those on edges; the level
/// is moved midway between the sides measured there until it settles.
ObjectEdges find_object(const Volume& volume, const FindObjectOptions& options = {});

/// T for (13), native units. Three-class images (air, soft tissue, bone) get one at the upper end
/// of the tissue outside the object: where the histogram, right of that tissue's peak, has fallen
/// to a tenth of it, but no more than half way up to the level, so that no edge profile is cut in
/// its middle, nor nearer to it than two and a half times the noise. Two-class ones need none:
/// where what is darker than the level does not fall into two classes half the object's contrast
/// apart, and four times the noise (the halves of one class's noise are 1.6 times it apart).
/// @param sides, level  of the object, see ObjectEdges.
/// @param noise         standard deviation, native units.
/// @return below every value if none is needed.
double find_threshold(const Volume& volume, const EdgeSides& sides, double level, double noise);

}  // namespace mesamis
