// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "mesamis/remesh/counters.h"
#include "mesamis/remesh/working_mesh.h"

namespace mesamis::remeshing {

/// Cuts the mesh into parts, works on each as on a mesh of its own, and joins them again.
///
/// The vertices are bisected recursively in a frame that turns with `round`, so that the borders
/// lie elsewhere each time. Vertices on a border are frozen meanwhile; so is what needs them.
/// The cut depends on the mesh alone and each part is worked on by one thread: the result has the
/// same bits for any number of threads.
///
/// @param mesh  without unused slots, before and afterwards.
/// @param work  is called once per part, concurrently.
/// @param seconds  optional; becomes the time spent on each part.
/// @return the sum of what the parts return, in their order.
Counters work_on_parts(WorkingMesh& mesh, int round, Index parts,
                       const std::function<Counters(WorkingMesh&)>& work,
                       std::vector<double>* seconds = nullptr);

}  // namespace mesamis::remeshing
