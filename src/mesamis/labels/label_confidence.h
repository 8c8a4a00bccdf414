// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/surface/smooth_memberships.h"

namespace mesamis::detail::labels {

/// Two labels that touch, in any order.
using LabelPair = std::array<Index, 2>;

/// Weights of labels against the image: how sure it is that a voxel has the label that it is given.
///
/// A label map is least exact at the borders of its objects. With the depth d of a voxel (from its
/// centre to where the nearest voxel of another label begins) and the depth D of the middle of
/// its object there (the greatest d that can be reached within the object in `margin`; no more than
/// the margin), r = d / D grows from 0 at the border to 1 in the middle or a margin inside, and
///   c = 0.005 + 0.03 (r / (1 - r))^2, at most kCertain.
/// So what is thinner than two voxels is certain throughout and never lost. Certain, too, is the
/// middle of walls and rods, where the depth falls to both sides, unless it is so small that a few
/// wrong labels may have made it: beside something thick, D would not tell it. Beside something so
/// thin the margin of its neighbours is a voxel and a half. Where the image shows nothing between two
/// labels, both are certain at their border: nothing else says where it is.
/// @param grid    labels at the nodes, mm.
/// @param margin  mm, > 0: the borders may be wrong by this.
/// @param unseen  pairs of labels between which the image shows no edge.
/// @return one weight per node, no unit. The border of the grid is no border of an object.
/// @throws InputError  if the sizes do not fit, or the margin is not positive and finite.
///
/// O(nodes), and near borders times the voxels in a ball of the margin. 17 bytes per node. The same
/// bits for any number of threads.
std::vector<float> label_confidence(const LabelGrid& grid, double margin,
                                    std::span<const LabelPair> unseen = {});

/// The weight of what is certain.
inline constexpr float kCertain = 1000;

}  // namespace mesamis::detail::labels
