// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::decimate {

/// A surface on its way: triangles over the original's points, which may have moved. With a
/// tolerance, each stands for some triangles of the original, parts of which lie near it, or for
/// none; every original is stood for.
struct Cover {
  std::vector<Vec3> points;  ///< mm
  std::vector<Triangle> triangles;
  std::vector<std::vector<Index>> originals;  ///< of each triangle, increasing
  std::vector<double> to_originals;    ///< of each triangle: none of its points lies farther from
                                       ///< the original, mm; infinity: not known
  std::vector<double> from_originals;  ///< of each triangle: no original that it stands for
                                       ///< lies farther from the surface, mm
};

/// A surface of whose triangles nothing is known.
inline Cover unproved(TriMesh surface) {
  return {std::move(surface.points), std::move(surface.triangles), {}, {}, {}};
}

/// Every triangle stands for itself.
inline Cover cover_of(const TriMesh& surface) {
  const std::vector<double> none(surface.triangles.size(), 0);
  Cover cover{surface.points, surface.triangles, {}, none, none};
  cover.originals.reserve(surface.triangles.size());
  for (Index t = 0; t < std::ssize(surface.triangles); ++t) cover.originals.push_back({t});
  return cover;
}

}  // namespace mesamis::detail::decimate
