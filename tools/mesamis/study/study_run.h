// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/report/run_summary.h"
#include "mesamis/report/verdict.h"
#include "mesamis/study/experiment.h"
#include "mesamis/surface/comparison.h"

/// The runs of a study: segmentation, and comparison with the reference.
namespace mesamis::detail::study {

/// The distances between a run's surface and the reference.
struct RunComparison {
  std::int64_t triangles = 0;            ///< of the surface, in the part that was measured
  std::int64_t reference_triangles = 0;  ///< of the reference, in the part that was measured
  DirectedDistances distances;           ///< from the reference to the surface; named as the run
  DirectedSummary reference_to_surface;  ///< of these distances
  DirectedSummary surface_to_reference;
  /// Difference of the mean distance (15) from the baseline's, percent of the baseline's.
  std::optional<double> variation_percent = std::nullopt;

  /// By how much the surface has fewer triangles than the reference, percent; negative if more.
  double triangle_reduction_percent() const;
};

/// The outcome of a planned run.
struct StudyRun {
  PlannedRun plan;
  Volume grid;                              ///< the volume segmented, without its samples
  std::optional<RunSummary> summary;        ///< none if the method failed
  TriMesh surface;                          ///< LPS mm; empty if there is none
  std::string surface_file;                 ///< its name in the study's folder; may be empty
  std::optional<RunComparison> comparison;  ///< none if it was not made or could not be made
  VerdictKind outcome = VerdictKind::kKept;
  std::string remark;   ///< why the outcome is not kKept; else empty
  std::string failure;  ///< why there is no surface to compare; else empty

  /// Whether the method converged and there is a surface to compare.
  bool converged() const { return summary && summary->converged && failure.empty(); }
};

/// Segments the volume of one planned run.
/// @param progress  optional; stages as mes_amis().
/// @return the run with its surface, not yet compared.
/// @throws InputError      as mes_amis(), or if there is no surface.
/// @throws NumericalError  as mes_amis().
/// @throws Cancelled       if progress says stop.
///
/// Time and memory as mes_amis() on the subsampled volume.
StudyRun segment_planned(const Experiment& experiment, const PlannedRun& plan,
                         const Progress& progress = {});

/// Marks a planned run as failed.
/// @param reason  one line.
/// @return a run without a surface, whose outcome is kNotConverged.
StudyRun failed_run(const PlannedRun& plan, const std::string& reason);

/// Refuses a reference that no run of the experiment could be compared with.
/// @param reference  LPS mm.
/// @throws InputError  if no triangle of it lies inside the experiment's volume, a voxel away from
///                     its faces. O(n) for n triangles.
void require_inside(const TriMesh& reference, const Experiment& experiment);

/// Measures the distances between the reference and the surface of a run.
///
/// In a cropped experiment only points inside the box of the run count, at least a voxel of the
/// full resolution away from its faces, from either surface to the whole of the other: at these
/// faces the reference continues and the surface of the run is closed.
/// @param reference  LPS mm, without unused points; see require_inside().
/// @param run        as segment_planned() returns it; one without a surface is returned as it is.
/// @return the run with its comparison; marked as failed, without a surface, if no triangle of the
///         surface or of the reference lies inside that box.
/// @throws InputError  as measure_distances(). Cost as there.
StudyRun with_comparison(const TriMesh& reference, const Experiment& experiment, StudyRun run);

/// Sets RunComparison::variation_percent of each run that has a comparison: the difference of its
/// mean distance (15) from that of the baseline among the runs.
/// @return the runs; without a baseline, or one with a mean distance above 0 mm, as they are.
std::vector<StudyRun> with_distance_variations(std::vector<StudyRun> runs);

}  // namespace mesamis::detail::study
