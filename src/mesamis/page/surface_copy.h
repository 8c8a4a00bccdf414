// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail {

/// A surface of fewer triangles to look at: points within one cell of a grid become one, and
/// triangles that lose a corner go. It need not stay closed. A surface that is small enough stays
/// as it is.
/// @param most  triangles, > 0, as a goal.
///
/// O(n log n) for n triangles, a few times.
TriMesh coarse_surface(const TriMesh& surface, std::int64_t most);

/// A gzipped MZ3 file of a surface, RAS, points rounded to a 2^14th of its size.
/// @param surface  LPS, mm; fewer than 2^31 triangles.
/// @throws InputError  if zlib cannot be started.
std::string mz3_gz(const TriMesh& surface);

}  // namespace mesamis::detail
