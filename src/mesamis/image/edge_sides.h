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
};

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
  double level = 0;           ///< midway between the two sides
  double threshold = 0;       ///< T for (13); below the image's minimum if none is needed
  std::size_t crossings = 0;  ///< of the smoothed image's grid lines with the level: the extent of
                              ///< the edges; marching cubes makes about two triangles each
};

/// Finds the bright object: CT from its crossings of 200 HU (bone), other images from Otsu's
/// threshold; the level is moved midway between the sides measured there until it settles.
///
/// Three-class images (air, soft tissue, bone) get a threshold T at the upper end of the tissue
/// outside the object: where the histogram, right of that tissue's peak, has fallen to a tenth of
/// it, but no more than half way up to the level, so that no edge profile is cut in its middle.
/// Two-class ones, where what is darker than the level does not fall into two classes half the
/// object's contrast apart, need none.
/// @param level  where crossings are counted instead of the level found, and nothing else.
ObjectEdges find_object(const Volume& volume, std::optional<double> level = std::nullopt);

}  // namespace mesamis
