// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/surface/smooth_memberships.h"

namespace mesamis::detail::surface {

/// The connected parts of all labels of a grid, neighbours as in GridMemberships.
struct LabelParts {
  std::vector<Index> of_node;
  std::vector<Index> label;  ///< of each part; parts are numbered in the order of their first nodes
};

/// Finds the parts.
LabelParts find_label_parts(const LabelGrid& grid);

}  // namespace mesamis::detail::surface
