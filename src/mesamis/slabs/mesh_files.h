// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mesamis/slabs/background.h"
#include "mesamis/slabs/tasks.h"

/// What the tasks on meshes share: names of files, and how a slab hands its mesh on.
namespace mesamis::detail {

enum class Side { kLow, kHigh };
inline Side opposite(Side side) { return side == Side::kLow ? Side::kHigh : Side::kLow; }

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

/// Writes mesh k of slab s: the cells at its borders for the seams ("border"), those around that the
/// neighbours see too ("rim"), and the others ("core").
/// @return the cells as work done.
SlabWork hand_on(const MeshRun& run, int k, Index s, const Piece& mesh);

/// Removes the nodes of slab g of the first grid, when all have made their first mesh.
void remove_grid_files(const SlabRun& run, Index g);

}  // namespace mesamis::detail
