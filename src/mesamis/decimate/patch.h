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

/// A part of a cover that is decimated by itself.
struct Patch {
  std::vector<Index> points;  ///< those of the original that it uses, increasing
  Cover cover;                ///< over these points
  std::vector<char> held;     ///< of each point, 1 if it must stay
  /// The triangles of other patches that touch it, over the original's points. They stay.
  std::vector<Triangle> around;
};

/// Adds rings of neighbours to the points chosen.
/// @param chosen  of each point, 1 or 0.
void choose_rings(const std::vector<Triangle>& triangles, int rings, std::vector<char>& chosen);

/// Cuts a cover into patches: the triangles whose centres lie in one box of a lattice. Points that
/// patches share are held in all of them, as are their neighbours: what touches a shared point
/// stays.
/// @param points  of the original.
/// @param side    of the boxes, mm, > 0; infinity: one patch, nothing held.
///
/// O(n log n) for n triangles.
std::vector<Patch> cut_into_patches(const std::vector<Vec3>& points, Cover cover, double side);

}  // namespace mesamis
