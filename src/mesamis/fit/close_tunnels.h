// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::fit {

/// By how much an image must rise for tunnels to close.
struct TunnelLift {
  /// Of each voxel, >= 0, in the unit of the image; no samples: there is nothing to close.
  Volume lift{};
  std::int64_t sheets = 0;  ///< that close a tunnel each, or several
  std::int64_t voxels = 0;  ///< of these sheets
};

/// Finds tunnels through thin walls that a faint sheet closes: a wall thinner than the blur is
/// darker than its edge's level where it is thinnest.
///
/// What is faint is thinned, the darkest voxels first, as long as no part, tunnel or cavity comes or
/// goes with a voxel; then bridges are cut and what they held is thinned too. Sheets are left. One
/// closes tunnels if
/// - it raises the Euler characteristic of the object (parts less tunnels, plus cavities);
/// - it touches one large part of the object at most: joint spaces and fractures stay open;
/// - it is thin: four fifths of its voxels have something darker than faint within three voxels;
/// - not all of it lies beside the object, unless it is small: narrow slits stay open.
///
/// Connected is what the edges of Kuhn's tetrahedra connect, with 14 neighbours.
/// @param height  the image over its level, in halves of the contrast there: 0 at the surface, about
///                1 within the object and -1 around it. Faint is what lies above -0.6.
/// @return what brings the sheets to 0.5, falling off within two voxels; nothing for more voxels than
///         an Index counts.
///
/// O(voxels log voxels), one thread but for the last step; 13 bytes per voxel beside the image.
TunnelLift find_tunnel_lift(Volume height);

}  // namespace mesamis::detail::fit
