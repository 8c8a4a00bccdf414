// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "mesamis/files/memory_budget.h"
#include "mesamis/image/slice_source.h"

/// Shared by the readers that can read some slices without the others.
namespace mesamis::detail::volume_files {

/// Appends the samples of these slices in native units; i runs fastest, then j, k. The room for
/// them was claimed; the reader claims what else it takes. Several threads may call it.
/// @throws InputError  as the format's own reader.
using SliceReader =
    std::function<void(const SliceRange& slices, MemoryBudget& budget, std::vector<float>& out)>;

}  // namespace mesamis::detail::volume_files
