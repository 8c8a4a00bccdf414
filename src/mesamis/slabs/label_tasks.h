// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/labels/label_block.h"
#include "mesamis/slabs/scratch.h"
#include "mesamis/slabs/slab_work.h"
#include "mesamis/slabs/stored_labels.h"
#include "mesamis/surface/extract_net.h"
#include "mesamis/surface/join_diagonals.h"
#include "mesamis/surface/match_volumes.h"
#include "mesamis/surface/partition.h"
#include "mesamis/surface/smooth_memberships.h"

/// The tasks that make smooth boundaries of a layer of labels, slab by slab, to the bits of
/// join_diagonals(), smooth_memberships() and extract_net_on_grid(), or
/// extract_partition_on_grid(), of the whole.
///
/// In their order: make_part_file(), find_parts(), join_parts(), learn_parts() on the labels as they
/// are; find_joins(), learn_joins(), and the first four again if there are any; find_wishes(),
/// let_yield(); smooth_slab(); measure_slab() until the volumes match; extract_slab(). What they
/// reach is bounded, but for the order in which nodes yield: let_yield() does that for all slabs in
/// turn; and for parts and volumes, which are numbers that learn_parts() and VolumeMatch add up.
namespace mesamis::detail::slabs {

/// What is known of the parts of a layer.
struct LayerParts {
  std::vector<std::vector<Index>> number;  ///< [slab][part of its own slices]: the part
  std::vector<Index> label;                ///< of each part
  std::vector<std::int64_t> nodes;         ///< of each part
  std::vector<std::int64_t> eighths;       ///< of each part, see voxel_eighths()
};

/// What the tasks on a layer know.
struct LayerRun {
  const StoredLabels& source;
  const Scratch& scratch;
  Index layer = 0;
  LabelBlock block;         ///< of the map's voxels; slices are counted from its first one
  std::vector<Index> cuts;  ///< slab s owns the slices cuts[s] to cuts[s + 1] - 1
  SmoothOptions smoothing{};
  std::optional<NetOptions> net{};    ///< how a net is extracted; none: the grid's tetrahedra are
  bool only_chosen = false;           ///< labels that the net does not choose are background
  std::vector<DiagonalJoin> joins{};  ///< after learn_joins(), of the block: labels have them
  LayerParts parts{};                 ///< after learn_parts()

  Index count() const { return static_cast<Index>(cuts.size()) - 1; }
  /// The file of what slab s has left.
  std::string file(const std::string& what, Index s) const {
    return "layer." + std::to_string(layer) + (joins.empty() ? "." : ".joined.") + what + "." +
           std::to_string(s);
  }
};

/// Makes room for the parts of all nodes.
SlabWork make_part_file(const LayerRun& run);
/// Finds the parts of the slices of slab s.
SlabWork find_parts(const LayerRun& run, Index s);
/// Finds which parts of the slabs s and s + 1 are one.
SlabWork join_parts(const LayerRun& run, Index s);
void learn_parts(LayerRun& run);
/// Finds the nodes of slab s that objects may take, see find_diagonal_joins().
SlabWork find_joins(const LayerRun& run, Index s);
/// Chooses of those of all slabs.
void learn_joins(LayerRun& run);
/// Finds the nodes of slab s that may yield.
SlabWork find_wishes(const LayerRun& run, Index s);
/// Lets the nodes of all slabs yield, one slab after the other.
SlabWork let_yield(const LayerRun& run);
/// Makes the memberships of slab s, whose volumes are not matched.
SlabWork smooth_slab(const LayerRun& run, Index s);
/// Measures the layers of cells of slab s.
/// @param match  its constants count, and the number of its round.
SlabWork measure_slab(const LayerRun& run, const VolumeMatch& match, Index s);
/// The layers of all slabs with these constants, after measure_slab().
std::vector<LayerVolumes> layers_of_slabs(const LayerRun& run, const VolumeMatch& match);
/// Extracts the boundaries in the cells of slab s.
SlabWork extract_slab(const LayerRun& run, const VolumeMatch& match, Index s);
/// The volumes of the labels, after learn_parts(): of each up to the greatest, mm^3.
std::vector<double> label_volumes(const LayerRun& run);
/// The boundaries of all slabs, after extract_slab(): mm, the block's first node at the origin.
PartitionSurface joined_boundaries(const LayerRun& run);

}  // namespace mesamis::detail::slabs
