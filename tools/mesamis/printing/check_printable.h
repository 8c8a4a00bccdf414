// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "mesamis/printing/prusa_info.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::printing {

/// What decides whether a surface can be printed. A slicer makes a hollow or truncated print of a
/// surface that is open or badly oriented, and reports success.
struct PrintCheck {
  SurfaceCheck surface;
  std::size_t self_intersections = 0;  ///< pairs of triangles; slicers unite what overlaps
  std::optional<PrusaInfo> prusa{};    ///< PrusaSlicer's own check; none where it was not run
};

/// Checks a surface without any slicer: topology, orientation, self-intersections.
///
/// @param surface  n triangles, mm.
/// @return PrintCheck::prusa is empty.
/// @throws InputError  if the surface is unsound, see require_sound().
///
/// O(n log n) for a surface that rarely meets itself.
PrintCheck check_printable(const TriMesh& surface);

/// Why the surface cannot be printed: "3 open edges, 1 triangle ...". It must be closed,
/// 2-manifold and face outward, and PrusaSlicer, where it checked the surface, must repair nothing.
/// Self-intersections are no flaw.
/// @return empty if it can be printed.
std::string print_flaws_of(const PrintCheck& check);

}  // namespace mesamis::detail::printing
