// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "support/shapes.h"

namespace mesamis {

/// The surface with its inside outside.
inline TriMesh turned(TriMesh surface) {
  for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

/// A cube of 10 with a cavity of 6 that holds an island of 2 with a cavity of 1; beside it a cube
/// of 3 and one of 0.5.
inline TriMesh nested() {
  TriMesh surface = joined(cube({0, 0, 0}, 10), turned(cube({2, 2, 2}, 6)));
  surface = joined(joined(surface, cube({4, 4, 4}, 2)), turned(cube({4.5, 4.5, 4.5}, 1)));
  return joined(joined(surface, cube({20, 0, 0}, 3)), cube({20, 5, 5}, 0.5));
}

}  // namespace mesamis
