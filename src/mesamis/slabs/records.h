// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/method/iteration.h"

namespace mesamis::detail::slabs {

/// Puts together what slabs have recorded of one pass: counts, energies and estimators add up; of
/// the solvers' figures the worst counts; means are weighted by cells. Where records are of slabs
/// that overlap (on the grid; estimators on meshes), the sum counts what is common more than once.
/// @param slabs  at least one.
Iteration sum_of_records(const std::vector<Iteration>& slabs);

}  // namespace mesamis::detail::slabs
