// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/image/slice_source.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/method/passes.h"
#include "mesamis/slabs/background.h"
#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/piece.h"
#include "mesamis/slabs/plan.h"
#include "mesamis/slabs/scratch.h"
#include "mesamis/slabs/slab_work.h"

/// The tasks of a run in slabs. Each reads what others have left in the scratch folder, and leaves
/// its own result there; it depends on nothing else, so that any process can do it at any time
/// after those.
///
/// For each mesh k, from 1: its slabs are cut (MeshRun, plan_next_mesh()); slabs adapt their own
/// cells up to their borders (first_mesh(), adapt_slab()), then the cells that touch a border
/// between two slabs are adapted as a piece of their own (seam()), and the functional is minimised
/// on each slab and what lies around it (solve(), finish()).
namespace mesamis::detail::slabs {

/// What all tasks know.
struct SlabRun {
  const SliceSource& source;
  const Scratch& scratch;
  SlabPlan plan;  ///< of voxels
  /// h_max at most least_thickness(): larger cells would reach over whole slabs.
  Chosen choice;
  /// What the level of each place exceeds that of the object by, native units, of the whole scan; no
  /// samples: there is one level.
  MappedItems<float> excess{};
  bool is_too_large = false;  ///< see SlabRunResult
};

/// What the surface in a slab asks for.
struct SlabExtent {
  double cells = 0;         ///< of the last mesh
  float low = 0, high = 0;  ///< bounds of the image
};

/// What is known of a slab of the first grid, beside its nodes.
struct GridSlab {
  GridWindow frame;  ///< of its nodes, without values
  SlabExtent extent;
  std::vector<double> complexities;  ///< of the metric, of each slice
  Iteration record;
};

/// Restores the slices of slab g, writes their spline, minimises on their grid, and asks for the
/// metric of the first mesh. Its complexity is that of as many cells as the slab's own surface asks
/// for: the number that the whole surface may have is not known yet.
SlabWork prepare_and_minimise(const SlabRun& run, Index g);
/// All slabs, after prepare_and_minimise().
std::vector<GridSlab> grid_slabs(const SlabRun& run);

/// The file of the image's spline.
inline constexpr const char* kImageFile = "image";

/// What is known of a mesh before it is made.
struct MeshPlan {
  /// Of as many slabs as those of voxels; cuts give all the same number of cells, as the metric
  /// predicts.
  SlabPlan slabs;
  std::vector<double> predicted;  ///< cells of each slab, as predicted, any unit
  double complexity = 0;          ///< of its metric at most
  double factor = 1;  ///< by which all sizes that were asked for are multiplied to keep that
};

/// What tasks on meshes know: parameters are final, the image is mapped.
struct MeshRun {
  const SlabRun& slabs;
  Prepared prepared;  ///< grey without samples
  RunInput input;
  std::vector<GridSlab> grid;
  std::vector<MeshPlan> meshes;  ///< [k - 1] of mesh k: the first, and those of plan_next_mesh()

  explicit MeshRun(const SlabRun& run);
  MeshRun(const MeshRun&) = delete;
  MeshRun& operator=(const MeshRun&) = delete;

  const MeshPlan& mesh(int k) const { return meshes[static_cast<std::size_t>(k - 1)]; }
  const SlabPlan& plan(int k) const { return mesh(k).slabs; }
  Index count() const { return slabs.plan.count(); }
};

/// Mesh 1 of slab s, from the grids around it.
SlabWork first_mesh(const MeshRun& run, Index s);
/// Mesh k around the border between the slabs s and s + 1.
SlabWork seam(const MeshRun& run, int k, Index s);
/// Minimises on mesh k of slab s.
SlabWork solve(const MeshRun& run, int k, Index s);
/// Plans the mesh after the last one that is planned, when solve() of all its slabs is done.
void plan_next_mesh(MeshRun& run);
/// Mesh k of slab s, k from 2.
SlabWork adapt_slab(const MeshRun& run, int k, Index s);
/// Minimises on mesh k of slab s, the last one, as the result needs it.
SlabWork finish(const MeshRun& run, int k, Index s);

/// What was recorded of the minimisations on the grid and on the meshes 1 to k; after solve(), and
/// of the last mesh after finish().
std::vector<Iteration> records_of(const MeshRun& run, int k);

/// @throws NumericalError  if a cell of the last mesh was lost between slabs.
void require_full(const MeshRun& run, int k);

/// How well the last mesh fits its metric; edges at borders count for both slabs; after finish().
MeshFit fit_of(const MeshRun& run, int k);

/// The whole last mesh and its fields; after finish().
Piece collect(const MeshRun& run, int k);

}  // namespace mesamis::detail::slabs
