// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mesamis/slabs/background.h"
#include "mesamis/slabs/tasks.h"

/// What the tasks on meshes share: names of files, and how a slab hands its mesh on.
namespace mesamis::detail {

enum class Side { kLow, kHigh };
/// Whether there is a slab on that side.
inline bool has_neighbour(const SlabPlan& plan, Index s, Side side) {
  return side == Side::kLow ? s > 0 : s + 1 < plan.count();
}

/// The height of a border of slab s.
inline double border_of(const SlabPlan& plan, Index s, Side side) {
  return plan.height(side == Side::kLow ? s : s + 1);
}

/// The stage of passes that tell nobody how far they have come: a task is one step.
const Stage& silent_stage();

/// What mesh k was made for, near a border of slab s.
std::string window_file(int k, Index s, Side side);

/// Remeshes a piece for mesh k, and takes over what is known around it.
/// @param complexity  of the metric on the piece: it bounds the cells.
Piece adapted(const MeshRun& run, int k, const TetMesh& start, const Background& background,
              double complexity);

/// Writes mesh k of slab s: the cells near its borders for the seams, and the others.
/// @return the cells as work done.
SlabWork hand_on(const MeshRun& run, int k, Index s, const Piece& mesh);

/// Removes the fields on the first grid of slab s, when all have made their first mesh.
void remove_grid_files(const SlabRun& run, Index s);

/// How the first grid of slab s was minimised on; after first_mesh().
Iteration grid_record(const SlabRun& run, Index s);

}  // namespace mesamis::detail
