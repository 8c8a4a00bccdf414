// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "mesamis/files/output_path.h"
#include "mesamis/image/slice_source.h"
#include "mesamis/run/outcome.h"
#include "mesamis/slabs/labels_in_slabs.h"
#include "mesamis/slabs/map_scan.h"
#include "mesamis/slabs/run_in_slabs.h"

namespace mesamis::detail::run {

/// A run in slabs for one object: all that is bright.
struct SlabRequest {
  const SliceSource& source;
  Settings settings{};
  SlabRunOptions slabs{};  ///< `mesh`: whether the outcome has its mesh; take_piece is not used
  /// Meshes that are written slab by slab as they come: a .vtu for each slab, "NAME_3.vtu", beside
  /// the index NAME.pvtu.
  std::vector<OutputPath> piece_meshes{};
  Frame frame = Frame::kLps;  ///< of these
};

/// What came out of it.
struct SlabOutcome {
  Outcome outcome;                 ///< without an image, unless its mesh is kept
  SlabRunResult work;              ///< its result is moved into the outcome
  std::optional<MappedScan> scan;  ///< the samples that the outcome refers to
};

/// Does what segment() does for one object, without ever holding the scan: see run_in_slabs().
/// @param scratch  folder for a copy of the scan, where a mesh needs the grey values below it.
/// @return on rank 0; nothing elsewhere.
/// @throws InputError, Cancelled  as run_in_slabs(), map_scan() and write_vtu(). Cost as
///                                run_in_slabs().
std::optional<SlabOutcome> segment_in_slabs(const SlabRequest& request,
                                            const std::filesystem::path& scratch, Team& team);

/// A run in slabs on labels.
struct LabelSlabRun {
  LabelSlabRequest labels;            ///< its scan, and how objects are found in it, follow
  const SliceSource* scan = nullptr;  ///< whose image places the surfaces; nullptr: labels alone
  Settings settings{};
  SlabRunOptions slabs{};
};

/// What came out of it.
struct LabelSlabOutcome {
  Outcome outcome;
  LabelSlabResult work;            ///< its result is moved into the outcome
  std::optional<MappedScan> scan;  ///< the samples that the outcome refers to
};

/// Does what segment() does for labels, their boundaries slab by slab: see
/// label_surfaces_in_slabs().
/// @param scratch  folder for a copy of the scan.
/// @return on rank 0; nothing elsewhere.
/// @throws InputError, Cancelled  as label_surfaces_in_slabs(), map_scan() and segment().
///
/// Cost as label_surfaces_in_slabs(); with a scan, rank 0 holds the block of it around the labels,
/// about 25 bytes per voxel.
std::optional<LabelSlabOutcome> segment_labels_in_slabs(const LabelSlabRun& run,
                                                        const std::filesystem::path& scratch,
                                                        Team& team);

}  // namespace mesamis::detail::run
