// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesamis/base/types.h"

namespace mesamis {

/// Three point indices.
using Triangle = std::array<Index, 3>;

/// A triangle surface; seen from outside the object, triangles turn counter-clockwise.
struct TriMesh {
  std::vector<Vec3> points;  ///< mm
  std::vector<Triangle> triangles;
};

/// Checks indices and coordinates of a surface. O(n + m) for n points and m triangles.
/// @throws InputError  if a triangle names a missing point or a coordinate is not finite.
void require_sound(const TriMesh& surface);

/// Flaws that matter to a slicer or solver, and measures. Triangles with a repeated index are
/// counted as degenerate and left out of all other counts.
struct SurfaceCheck {
  std::int64_t open_edges = 0;         ///< edges with one triangle
  std::int64_t nonmanifold_edges = 0;  ///< edges with more than two
  std::int64_t misoriented_edges = 0;  ///< edges that both triangles traverse in the same direction
  std::int64_t nonmanifold_points = 0;    ///< points whose triangles form more than one fan
  std::int64_t degenerate_triangles = 0;  ///< a repeated index
  std::int64_t components = 0;            ///< parts connected by edges
  double volume = 0;                      ///< mm^3, signed: positive when oriented outward
  double area = 0;                        ///< mm^2
  /// The components of a closed surface: skins around matter, whose volume is not negative, and
  /// skins around a hole. 0 where there are open edges.
  std::int64_t islands = 0, cavities = 0;

  /// Every edge has two triangles or more; the volume of an open surface has no meaning.
  bool closed() const noexcept { return open_edges == 0; }
  /// Every edge joins two triangles (one on a rim), every point has one fan, orientation agrees.
  bool manifold() const noexcept {
    return nonmanifold_edges == 0 && nonmanifold_points == 0 && misoriented_edges == 0 &&
           degenerate_triangles == 0;
  }
};

/// Counts the flaws of a surface and measures it.
/// @throws InputError  as require_sound().
///
/// O(n log n) for n triangles; about 100 bytes per triangle. The same bits for any number of
/// threads.
SurfaceCheck check_surface(const TriMesh& surface);

/// Measures the area of a surface.
/// @param surface  sound, see require_sound(); mm.
/// @return mm^2; the bits of SurfaceCheck::area.
///
/// O(n) for n triangles. The same bits for any number of threads.
double surface_area(const TriMesh& surface);

/// Measures the volume within a surface.
/// @param surface  sound, see require_sound(), and closed; mm.
/// @return mm^3, negative if it faces inward; the bits of SurfaceCheck::volume.
///
/// O(n) for n triangles. The same bits for any number of threads.
double surface_volume(const TriMesh& surface);

/// Why a surface is not closed or not a 2-manifold, as "3 open edges, 1 points ..."; "" if it is.
std::string flaws_of(const SurfaceCheck& check);

/// The components in words: "5 components (1 island, 4 cavities)"; of an open surface their number.
std::string components_text(const SurfaceCheck& check);

/// Why a surface does not bound a solid: the flaws of flaws_of(), or a volume that is not positive;
/// "" if it does.
std::string solid_flaws_of(const SurfaceCheck& check);

}  // namespace mesamis
