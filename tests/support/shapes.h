// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// A cube of twelve triangles, outward.
inline TriMesh cube(const Vec3& lo = {0, 0, 0}, double side = 1) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back(lo + side * Vec3{double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Both surfaces in one; no point is shared.
inline TriMesh joined(TriMesh a, const TriMesh& b) {
  const auto shift = static_cast<Index>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const Triangle& t : b.triangles) {
    a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
  return a;
}

/// Puts a point into the first triangle, beside the middle of its first edge.
/// @param share  of the way from there to the third corner.
/// @return the thin triangle at that edge, which becomes the first.
inline Triangle add_thin_triangle(TriMesh& surface, double share) {
  const auto [a, b, c] = surface.triangles[0];
  const auto beside = static_cast<Index>(surface.points.size());
  const Vec3 middle = 0.5 * (surface.points[a] + surface.points[b]);
  surface.points.push_back(middle + share * (surface.points[c] - middle));
  surface.triangles[0] = {a, b, beside};
  surface.triangles.insert(surface.triangles.end(), {{b, c, beside}, {c, a, beside}});
  return surface.triangles[0];
}

/// Triangles that share nothing, with corners in the unit cube stretched by `stretch`.
inline TriMesh random_triangles(std::size_t count, const Vec3& stretch, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  TriMesh mesh;
  for (std::size_t t = 0; t < count; ++t) {
    const auto first = static_cast<Index>(mesh.points.size());
    for (int i = 0; i < 3; ++i) {
      mesh.points.push_back({stretch.x * uniform(generator), stretch.y * uniform(generator),
                             stretch.z * uniform(generator)});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace mesamis
