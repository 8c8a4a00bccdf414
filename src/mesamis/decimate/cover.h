// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// A surface on its way: triangles over points of the original. With a tolerance, each stands for
/// some triangles of the original, parts of which lie nearest to it, or for none; every original
/// is stood for.
///
/// While the surface is deformed step by step, each of its points goes back to one of the original.
/// The drift of a triangle bounds how far any of its points is from there.
struct Cover {
  std::vector<Triangle> triangles;
  std::vector<std::vector<Index>> originals;  ///< of each triangle, increasing
  std::vector<double> drift;                  ///< of each triangle, mm; infinity: not known
};

/// Every triangle stands for itself.
inline Cover cover_of(const TriMesh& surface) {
  Cover cover{surface.triangles, {}, std::vector<double>(surface.triangles.size(), 0)};
  cover.originals.reserve(surface.triangles.size());
  for (Index t = 0; t < std::ssize(surface.triangles); ++t) cover.originals.push_back({t});
  return cover;
}

}  // namespace mesamis
