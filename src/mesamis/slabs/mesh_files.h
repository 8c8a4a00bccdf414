// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>
#include <string>

#include "mesamis/slabs/background.h"
#include "mesamis/slabs/tasks.h"

/// What the tasks on voxels and on meshes share.
namespace mesamis::detail::slabs {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

/// Below it, what a slab leaves goes to its lower border, above it to the upper one. The first and
/// the last slab have one border each.
inline double middle_of(const SlabPlan& plan, Index s) {
  if (!has_neighbour(plan, s, Side::kLow)) return -kInfinity;
  if (!has_neighbour(plan, s, Side::kHigh)) return kInfinity;
  return (plan.height(s) + plan.height(s + 1)) / 2;
}

/// The file of slab s of mesh k.
std::string file_of(const char* what, int k, Index s);

/// Between the lowest and the highest centroid of a slab's cells: they need not lie between its
/// borders, since they come of cells that do.
struct Heights {
  double low = 0, high = 0;
};

/// What was recorded of the minimisation on a mesh.
struct MeshRecord {
  Iteration iteration;
  Heights heights;
  double volume = 0;        ///< of the slab's cells, length units^3
  double top = -kInfinity;  ///< the height of the highest node
};

/// After solve(), and of the last mesh after finish().
MeshRecord mesh_record(const MeshRun& run, int k, Index s);

/// The stage of passes that tell nobody how far they have come: a task is one step.
const Stage& silent_stage();

/// What the first mesh is made for, between two heights.
/// @param own   whose nodes are not those of another slab.
/// @param work  where the bytes of others are counted.
std::unique_ptr<Background> grid_background(const MeshRun& run, double low, double high, Index own,
                                            SlabWork& work);

/// Remeshes a piece for the next mesh, and takes over what is known around it.
/// @param complexity  of the metric on the piece: it bounds the cells.
/// @param thickness   of the thinnest slab that the piece is of, length units: edges along z are no
///                    longer than half of it.
Piece adapted(const MeshRun& run, const TetMesh& start, const Background& background,
              double complexity, double thickness);

/// Writes mesh k of slab s: the cells that touch its borders, which are still to be adapted, for
/// the seams ("border"), those around that the neighbours see too ("rim"), and the others ("core").
/// @param work  to which the cells are added.
void hand_on(const MeshRun& run, int k, Index s, const Piece& mesh, SlabWork& work);

/// Removes the nodes of slab g of the first grid, when all have made their first mesh.
void remove_grid_files(const SlabRun& run, Index g);

}  // namespace mesamis::detail::slabs
