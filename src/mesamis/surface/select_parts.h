// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/surface/nesting.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// Which parts of a closed surface to keep. A part inside a part that is removed is removed too.
struct PartSelection {
  double volume_min = 0;          ///< mm^3; removes smaller islands, fills smaller cavities
  std::int64_t keep_largest = 0;  ///< so many islands, by the volume of their skin; 0: all
  bool fill_cavities = false;     ///< every cavity is filled
  bool largest_stays = false;     ///< however small it is
};

/// What select_parts() found and removed.
struct SelectionReport {
  std::int64_t islands = 0, cavities = 0;                 ///< before
  std::int64_t islands_dropped = 0, cavities_filled = 0;  ///< of them
  double volume_dropped = 0, volume_filled = 0;           ///< mm^3, each skin's whole volume
};

/// Which components of a closed surface go.
struct PartChoice {
  std::vector<char> goes;  ///< of each component
  SelectionReport report;
};

/// Chooses the components that a selection does not keep.
/// @param parts    n components, the largest absolute volume first.
/// @param nesting  of them.
PartChoice choose_parts(std::span<const SurfaceComponents::Size> parts, const Nesting& nesting,
                        const PartSelection& selection);

/// Removes islands and fills cavities of a closed surface.
/// @param surface  n triangles, mm; closed and manifold.
/// @param report   optional.
/// @return the triangles kept and their points, in their order.
/// @throws InputError  if the surface is not closed or not manifold.
///
/// O(n log n).
TriMesh select_parts(const TriMesh& surface, const PartSelection& selection,
                     SelectionReport* report = nullptr);

}  // namespace mesamis::detail::surface
