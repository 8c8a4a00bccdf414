// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/remesh/split.h"
#include "mesamis/remesh/workbench.h"

namespace mesamis::detail::remesh {

/// Splits cells that fit the metric at their vertices but not inside, where it is much finer: thin
/// features in a coarse mesh.
///
/// About 2^18 probes are spread over the box by volume, each cell of some size getting its
/// share; a cell whose probes ask for many cells is halved until a vertex sees the feature.
/// @return the number of splits.
std::int64_t split_unseen_detail(Workbench& bench, const SplitRule& rule);

/// Integral of sqrt(det M) over the box, from as many probes on a lattice.
double probe_complexity(const MetricSampler& sampler, const Box& box);

}  // namespace mesamis::detail::remesh
