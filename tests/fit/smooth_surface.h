// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/fit/smooth_surface.h"

namespace mesamis {

/// Moves a surface to its smooth places.
inline TriMesh smooth_surface(const TriMesh& surface, const VoxelGrid& grid, const Links& links,
                              const SmoothingOptions& options = {}) {
  return moved_to(surface, grid, smooth_places({surface, links}, grid, options));
}

}  // namespace mesamis
