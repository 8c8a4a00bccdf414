// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "mesamis/base/single_precision.h"
#include "mesamis/surface/partition.h"

namespace mesamis::detail::surface {

/// Which contacts between objects are opened, and how far.
struct ContactOptions {
  int depth = 2;   ///< edges, >= 1: what is less deep everywhere is opened
  double gap = 0;  ///< mm, > 0, a tenth of a voxel or so: how far each side moves away at most
  /// Where a point lies in a file: there both sides are apart, too. Default: in single precision.
  std::function<Vec3(const Vec3&)> in_file = [](const Vec3& p) { return rounded(p); };
};

/// Opens contacts between objects where these are narrow: as most are by which the labels of two
/// bones that do not touch share a few voxel faces. Both sides get a boundary of their own against
/// the background, so that each can be smoothed as if it were alone.
///
/// All contacts together are opened as a set is in mathematical morphology: the depth of a point is
/// the number of edges that lead along contacts to the background; what has no point of at least
/// the given depth within as many edges is opened. Contacts of one object with several others count
/// as one, so that those that lie deep stay, even where each is narrow. So do contacts at the border
/// of the box, where the background would be pinched, and where the two sides would meet something.
/// @param partition  without self-intersections, also in a file.
/// @param chosen     of each material 1 if its surface is wanted; the others are background, as is
///                   material 0.
/// @return the same triangles, of which some came twice; closed, 2-manifold boundaries of each
///         chosen object and of all else, without self-intersections, also once their points are
///         in a file.
///
/// O(n log n) for n triangles. The same bits for any number of threads.
PartitionSurface open_narrow_contacts(PartitionSurface partition, std::span<const char> chosen,
                                      const ContactOptions& options);

}  // namespace mesamis::detail::surface
