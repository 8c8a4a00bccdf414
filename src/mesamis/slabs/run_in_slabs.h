// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/image/slice_source.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/slabs/plan.h"
#include "mesamis/slabs/slab_work.h"
#include "mesamis/slabs/team.h"

/// Scans that are larger than the memory: the whole method, slab by slab.
namespace mesamis::detail::slabs {

/// How a scan is worked on in slabs.
struct SlabRunOptions {
  /// In how many turns a process would work through all slabs, at least 1: the slabs of a turn, one
  /// at least, are worked on at a time, in threads. Default: turns of 2^26 voxels. Nothing depends
  /// on it but memory and time.
  std::optional<Index> turns{};
  std::optional<Index> slabs{};   ///< default: as plan_slabs(); another number, another result
  std::filesystem::path scratch;  ///< a folder on a disk that all processes see; made where missing
  /// Of so many the parameters are chosen, at most; another number, another result.
  std::size_t most_looked_at = std::size_t{1} << 27;
  bool keep_scratch = false;  ///< at the end; else what is in the folder goes
  bool mesh = true;           ///< whether the result has its mesh and fields
  bool grey = false;          ///< whether to find SlabRunResult::grey
  bool resumable = true;      ///< a run that fails leaves its files, to be gone on with
  std::string input{};        ///< what tells this scan from others, such as a path and a date
  /// Optional; "slabs: ..." and the stages of mes_amis(). Called from any thread, one at a time.
  Progress progress{};
  /// Optional: takes the mesh of each slab in turn, with its fields as Result has them of the
  /// whole; called on rank 0. What fields have at nodes of two slabs may differ within the solver's
  /// tolerance, but for u.
  std::function<void(Index slab, const Result& piece)> take_piece{};
};

/// Voxels that a process works on at a time, unless turns are asked for.
inline constexpr std::size_t kVoxelsOfATurn = std::size_t{1} << 26;

/// @throws InputError  for fewer than one turn.
void require_turns(const SlabRunOptions& options);

/// A result, and how it came about.
struct SlabRunResult {
  Result result;
  bool is_too_large = false;   ///< for a level of each place, which was asked for: it has one level
  std::vector<double> grey{};  ///< of the points of the surface, see surface_grey(); if asked for
  SlabPlan plan;               ///< of voxels
  SlabPlan mesh_plan;          ///< of the last mesh: as many slabs, cut elsewhere
  std::vector<SlabWork> slabs;  ///< one per slab
  std::int64_t own_rows = 0;    ///< rows without those that slabs have in common
  std::int64_t own_cells = 0;   ///< of all meshes, each cell once
};

/// Segments a scan as mes_amis() does, without ever holding more of it than the slabs of a turn.
///
/// The parameters come from the whole scan where it has no more than most_looked_at voxels, and then
/// are those of mes_amis(); else from so many voxels of consecutive slices, those whose samples vary
/// most, and there is one level for all places. The image is restored and minimised on slab by
/// slab, each with the slices around that matter to it. Each mesh is adapted in two steps: slabs on
/// their own, their borders kept; then the cells around each border, kept at their own borders. On
/// meshes the functional is minimised slab by slab with the cells around. Surfaces are extracted
/// slab by slab, follow the image and are decimated, each in two steps as the mesh: the memory of
/// rank 0 holds the decimated surface, and the mesh if that is asked for. Only where a number of
/// triangles is asked for, or no decimation, rank 0 holds the whole surface as extracted.
///
/// The scan alone decides how many slabs there are, unless they are asked for. The result depends
/// on the scan, the settings and that number: not on how many are worked on at a time, not on the
/// number of processes, not on threads, not on whether a run was killed and started again. Where
/// there is one slab, it is that of mes_amis().
///
/// @param source    read by slabs, from several threads at the same time.
/// @param settings  valid; no preview, no crop, no band, and until the surface has settled.
/// @param options   how many slabs, and where scratch files go: about 4 bytes per voxel, 16 per
///                  node of the first grid, 200 per cell, 200 per triangle as extracted. A folder
///                  with files of the same run is gone on with.
/// @param team      the processes that all call this function with the same arguments.
/// @return on rank 0; nothing elsewhere.
/// @throws InputError  as mes_amis(), plan_slabs() and the source; or if the folder holds files of
///                     another run.
/// @throws Cancelled   if progress says stop; the folder is kept.
///
/// Time as mes_amis(), and what overlaps add. Memory of a process: about that of mes_amis() for the
/// slabs that it works on at a time; of rank 0 also the surface, and where it is asked for the
/// mesh, about 60 bytes per cell: also for grey values where the surface is not decimated slab by
/// slab.
std::optional<SlabRunResult> run_in_slabs(const SliceSource& source, const Settings& settings,
                                          const SlabRunOptions& options, Team& team);

}  // namespace mesamis::detail::slabs
