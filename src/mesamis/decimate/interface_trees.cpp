// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/interface_trees.h"

#include <algorithm>
#include <utility>

namespace mesamis::detail::decimate {

std::vector<Index> interfaces_of_points(const SplitSurface& split) {
  constexpr Index kNotYet = -2;
  std::vector<Index> of(split.surface.points.size(), kNotYet);
  for (std::size_t t = 0; t < split.interface.size(); ++t) {
    for (const Index p : split.surface.triangles[t]) {
      of[p] = of[p] == kNotYet || of[p] == split.interface[t] ? split.interface[t] : kNoIndex;
    }
  }
  std::replace(of.begin(), of.end(), kNotYet, kNoIndex);
  return of;
}

InterfaceTrees::InterfaceTrees(const SplitSurface& split, std::size_t count) : chosen_(count) {
  std::vector<std::vector<Corners>> corners(count);
  for (std::size_t t = 0; t < split.interface.size(); ++t) {
    const std::size_t own = at(split.interface[t]);
    chosen_[own].push_back(static_cast<Index>(t));
    corners[own].push_back(corners_of(split.surface, split.surface.triangles[t]));
  }
  trees_.reserve(count);
  for (std::vector<Corners>& own : corners) trees_.emplace_back(std::move(own));
}

}  // namespace mesamis::detail::decimate
