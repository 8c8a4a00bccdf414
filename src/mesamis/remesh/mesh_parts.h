// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "mesamis/remesh/counters.h"
#include "mesamis/remesh/working_mesh.h"

namespace mesamis::detail::remesh {

/// How to cut a mesh into parts.
struct PartSchedule {
  int round = 0;    ///< turns the frame of the cuts
  Index parts = 1;  ///< > 0
};

/// What was done on the parts.
struct PartsReport {
  Counters counters;            ///< summed in the order of the parts
  std::vector<double> seconds;  ///< wall time of each part
};

/// Cuts the mesh into parts, works on each as on a mesh of its own, and joins them again.
///
/// The vertices are bisected recursively in a frame that turns with the round, so that the borders
/// lie elsewhere each time. Vertices on a border are frozen meanwhile; operations that would change
/// them are not possible. The cut depends on the mesh alone and each part is worked on by one
/// thread: the result has the same bits for any number of threads.
///
/// @param mesh  without unused slots, before and afterwards.
/// @param work  is called once per part, concurrently.
PartsReport work_on_parts(WorkingMesh& mesh, const PartSchedule& schedule,
                          const std::function<Counters(WorkingMesh&)>& work);

}  // namespace mesamis::detail::remesh
