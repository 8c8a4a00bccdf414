// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/decimate/cover.h"

namespace mesamis::detail::decimate {

/// A part of a cover that is decimated by itself.
struct Patch {
  std::vector<Index> points;  ///< those of the original that it uses, increasing
  Cover cover;                ///< over these points
  std::vector<char> held;     ///< of each point, 1 if it must stay
  /// The triangles of other patches that touch it, over the original's points. They stay.
  std::vector<Triangle> around;
};

/// Adds rings of neighbours to the points chosen.
/// @param chosen  of each point, 1 or 0.
void choose_rings(const std::vector<Triangle>& triangles, int rings, std::vector<char>& chosen);

/// The same where several points may be copies of one: with a point its copies are chosen.
/// @param first_copy  of each point the first of its copies, itself if there are no others.
void choose_rings(std::vector<Triangle> triangles, std::span<const Index> first_copy, int rings,
                  std::vector<char>& chosen);

/// Holds points of a patch, the corners of the triangles that stand for any of these originals, and
/// so many rings of points around all these.
/// @param points     of the patch, in any order.
/// @param originals  increasing.
void hold(Patch& patch, const std::vector<Index>& points, const std::vector<Index>& originals,
          int rings);

/// Cuts a cover into patches: the triangles whose centres lie in one box of a lattice. This begins
/// half a side before the cover: so the planes of one with twice the side lie midway between those
/// of another. Points that patches share are held in all of them, as are their neighbours: what
/// touches a shared point stays.
/// @param side    of the boxes, mm, > 0; infinity: one patch, of which nothing is held but for what
///                touches others than the chosen.
/// @param chosen  of each point, 1 or 0: triangles without a chosen corner are no part of these
///                patches, but make one more, the last, of which all is held; empty: all are.
///
/// O(n log n) for n triangles.
std::vector<Patch> cut_into_patches(Cover cover, double side, const std::vector<char>& chosen = {});

}  // namespace mesamis::detail::decimate
