// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/method/label_surfaces.h"
#include "mesamis/slabs/run_in_slabs.h"

/// Label maps that are larger than the memory.
namespace mesamis::detail::slabs {

/// A label map as it was read.
struct ReadLabels {
  LabelMap map;
  std::vector<std::string> warnings{};  ///< one line each
};

/// The labels of a run in slabs.
struct LabelSlabRequest {
  /// Reads the map. Called once, on rank 0; not by a run that resumes after it.
  std::function<ReadLabels()> read;
  /// Chooses segments, which become those of the result: each once. Called on every rank with the
  /// map's grid and segments; its layers are empty. It may throw.
  std::function<std::vector<Segment>(const LabelMap& head)> choose;
  /// Where the voxels of the scan lie that places the surfaces: the map is brought to them. Nothing:
  /// the labels alone.
  std::optional<VoxelGrid> scan{};
  std::optional<double> margin{};  ///< mm, see margin_of(); with a scan only
  /// With a scan: finds the objects in it, of boundaries that were extracted; called on rank 0, by
  /// find_labelled_objects() in the end.
  std::function<LabelResult(const LabelRequest&)> find{};
};

/// The surfaces of labels, and how they came about.
struct LabelSlabResult {
  LabelResult result;
  LabelMap head;                      ///< the map, on the scan's grid if any, without its layers
  std::vector<std::string> warnings;  ///< of reading it
  std::vector<Segment> chosen;        ///< its segments that were chosen
  /// Slab s has the slices cuts[s] to cuts[s + 1] - 1 of the block around the chosen segments,
  /// counted as those of the map: the first may be below 0.
  std::vector<Index> cuts;
  std::vector<SlabWork> slabs;  ///< one per slab: of `voxels` those at a time, the most of any task
};

/// Makes surfaces of a label map as surfaces_of_labels() does, or with a scan what its `find` makes
/// of the boundaries, to the bit, without holding the memberships of more voxels than those of the
/// slabs of a turn.
///
/// Labels are read whole (two bytes per voxel and layer) and written to the scratch folder. Parts,
/// memberships, volumes and boundaries are found slab by slab, each with the slices around it that
/// matter to it; rank 0 joins the boundaries, smooths and decimates them. Which nodes yield to
/// their neighbours is decided in their order: by one process, one slab at a time.
///
/// The result depends on the labels and settings alone: not on the number of slabs, turns,
/// processes or threads, nor on whether a run was killed and started again.
///
/// @param settings  valid.
/// @param options   `slabs` as in plan, else slabs of 64 slices or slightly more; `input` tells this
///                  map from others; mesh, grey and take_piece are not used.
/// @param team      the processes that all call this function with the same arguments.
/// @return on rank 0; nothing elsewhere.
/// @throws InputError  as surfaces_of_labels() and the functions of the request; for slabs that are
///                     thinner than two slices; for labels that flow, see
///                     starts_from_labels(); or if the folder holds files of another run.
/// @throws Cancelled   if progress says stop; the folder is kept.
///
/// Time as surfaces_of_labels(), and for each slab that of 28 slices more. Memory of a process:
/// about 70 bytes per voxel of the slabs that it works on at a time and of those slices; of rank 0
/// also the map while it is read, and the boundaries.
std::optional<LabelSlabResult> label_surfaces_in_slabs(const LabelSlabRequest& request,
                                                       const Settings& settings,
                                                       const SlabRunOptions& options, Team& team);

}  // namespace mesamis::detail::slabs
