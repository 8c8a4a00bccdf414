// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/surface/partition.h"

namespace mesamis::detail::decimate {

/// The boundaries of a partition cut into interfaces, along the curves where other than two
/// triangles share an edge, and at points where interfaces only touch: a 2-manifold with rims. Each
/// interface has its own copies of the points on its rim.
struct Interfaces {
  TriMesh surface;                ///< triangles in the order of the partition's
  std::vector<Index> origin;      ///< of each point: that of the partition; never falls
  std::vector<Index> first_copy;  ///< of each point: the first one of the same origin
  std::vector<char> at_rim;       ///< of each point, 1 if it is on a rim, or one of copies
  /// Of each point, 1 if it is within a curve, not at an end: three interfaces or more, all
  /// different, go on through it to the same two points, and no other touches it.
  std::vector<char> within_curve;
  std::vector<char> touches_itself;  ///< of each point, 1 if an interface has several copies of it
  std::vector<Index> of_point;  ///< the interface of each point; numbered in the order of points
  Index count = 0;              ///< of interfaces
};

/// Cuts a partition into interfaces.
/// @throws InputError  if there is not a pair of sides for each triangle, a triangle has a repeated
///                     corner, triangles of different sides share an edge that no third one has, a
///                     interface is not a 2-manifold with one orientation, and as require_sound().
///
/// O(n log n) for n triangles.
Interfaces cut_into_interfaces(const PartitionSurface& partition);

/// The triangles of each interface, over all points of the interface.
/// @param triangles  over the points of the interfaces.
std::vector<TriMesh> split_interfaces(const Interfaces& interfaces,
                                      const std::vector<Triangle>& triangles);

}  // namespace mesamis::detail::decimate
