// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::page {

/// A surface to look at, with a value at each point, or none.
struct SurfaceCopy {
  TriMesh surface;             ///< LPS, mm; fewer than 2^31 triangles
  std::vector<double> values;  ///< mm; empty, or one per point
};

/// A surface of fewer triangles to look at: points within one cell of a grid become one, with the
/// mean of their values, and triangles that lose a corner go. It need not stay closed. A surface
/// that is small enough stays as it is.
/// @param most  triangles, > 0, as a goal.
///
/// O(n log n) for n triangles, a few times.
SurfaceCopy coarse_surface(const SurfaceCopy& copy, std::int64_t most);

/// A gzipped MZ3 file of a surface, RAS, points rounded to a 2^14th of its size, values to a
/// 2^8th of the greatest.
/// @throws InputError  if zlib cannot be started.
std::string mz3_gz(const SurfaceCopy& copy);

}  // namespace mesamis::detail::page
