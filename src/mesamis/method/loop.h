// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/method/mes_amis.h"
#include "mesamis/method/passes.h"

/// The loop of Algorithm 2.
namespace mesamis::detail::method {

/// What the loop leaves: the last mesh, the fields that belong to it, and its history.
struct Loop {
  State state;
  Minimum minimum;
  std::vector<Iteration> passes;
  bool settled = false;
  bool stopped = false;  ///< by the caller, with meshes still to make
};

/// Minimises on the grid and adapts, until the loop has settled or made all its meshes; then
/// minimises once more.
/// @param progress  stages "adaptation k of n" and "final minimisation".
/// @param enough    optional; asked before each adaptation from 2 on. The fields of the loop that
///                  it stops depend on the number of its adaptations alone.
/// @throws Cancelled  if progress says stop.
Loop run_loop(const RunInput& run, const Progress& progress, const HasEnough& enough = {});

/// Puts what the loop leaves into a result: mesh, fields, metric and its fit, history, and whether
/// it has converged. World frame; a left-handed grid turns every cell round. The mesh may be empty,
/// and then has no fit.
void deliver_mesh(const RunInput& run, Loop loop, Result& result);

}  // namespace mesamis::detail::method
