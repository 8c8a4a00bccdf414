// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/study/study_run.h"

namespace mesamis::detail::study {

/// The distances from the reference of the runs that have some, in their order. O(n) for n
/// distances, which are copied.
inline std::vector<DirectedDistances> measured_distances(std::span<const StudyRun> runs) {
  std::vector<DirectedDistances> directions;
  for (const StudyRun& run : runs) {
    const bool measured = run.comparison && !run.comparison->distances.from_vertices.empty();
    if (measured) directions.push_back(run.comparison->distances);
  }
  return directions;
}

}  // namespace mesamis::detail::study
