// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

/// Points spread over a surface evenly by area.
namespace mesamis::detail::surface {

/// Samples the surface evenly by area: one point in each of `count` equal shares of it.
///
/// The places within the triangles follow a sequence of low discrepancy: the points are the same
/// for the same surface and count.
///
/// @param surface  mm.
/// @return `count` points in mm, in the order of the triangles.
/// @throws InputError  if the surface is not sound, or its area is 0 or not finite although count
///                     is not 0.
///
/// O(m + count) for m triangles.
std::vector<Vec3> sample_by_area(const TriMesh& surface, std::size_t count);

/// A place on a surface and the direction out of it.
struct TriangleSample {
  Vec3 position;  ///< mm, or as scaled
  Vec3 normal;    ///< of length 1, outward
};

/// Samples the surface at centroids of triangles, evenly by area: about one sample per triangle, of
/// which a large triangle gets several at its centroid and a small one shares one with others.
///
/// Small triangles crowd where a surface is curved; sampled so, such places do not outweigh the
/// others in a mean or a median.
///
/// @param surface  mm, or any other unit of length; oriented outward.
/// @param scale    no unit; every position is multiplied by it.
/// @return in the order of the triangles.
/// @throws InputError  as sample_by_area(), for a count of at least 1.
///
/// O(m) for m triangles.
std::vector<TriangleSample> sample_triangles_by_area(const TriMesh& surface, double scale = 1);

}  // namespace mesamis::detail::surface
