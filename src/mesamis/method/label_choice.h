// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/labels/label_block.h"
#include "mesamis/method/choose.h"

namespace mesamis::detail::method {

/// Chosen labels in a block of a grid.
struct ChosenLabels {
  const LabelMap& map;
  const LabelBlock& block;
  const std::vector<Segment>& chosen;  ///< of the map
};

/// What chosen labels cover of a scan, native units.
struct LabelledValues {
  /// Half way between the voxels that are chosen and the others; none: they are alike.
  std::optional<double> level{};
  Window medians{};  ///< the least and the greatest of the medians of the labels
};

/// Measures what labels cover.
/// @param part  the scan in their block.
///
/// O(voxels * layers).
LabelledValues values_of_labels(const VolumeView& part, const ChosenLabels& labels);

/// Chooses how a scan is restored in which labels choose objects: from the whole scan, or from the
/// slices of the largest scatter where it has more than 2^24 voxels. So noise, blur and window, and
/// with them an object, do not depend on which others are chosen, unless the window has to be
/// widened for their values.
/// @param scan      native units, see require_usable().
/// @param settings  with the level, if it is known.
/// @param values    of the chosen labels.
/// @return for prepare_slab(); its level is the one that is known, or that of the values.
/// @throws InputError  if the window holds none of the samples.
///
/// O(voxels that are looked at); two copies of their samples at a time.
Chosen choose_beside_labels(const VolumeView& scan, const ImageSettings& settings,
                            const LabelledValues& values);

}  // namespace mesamis::detail::method
