// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "comparison.h"
#include "mesamis/base/progress.h"
#include "mesamis/image/volume.h"
#include "mesamis/settings.h"
#include "mesamis/surface/tri_mesh.h"

/// How much of the surface is left when the scan has fewer samples: the experiments of section 5 of
/// the paper, on any scan with a reference surface.
namespace mesamis {

/// One run of the method on a thinned volume: what is between the voxels kept is not seen.
struct PlannedRun {
  std::string name;                      ///< "s4", "region_full": its surface is NAME.ply
  int s = 1;                             ///< every s-th slice along the grid's third axis is kept
  std::array<Index, 3> stride{1, 1, 1};  ///< every stride-th voxel per direction is kept
};

/// A scan, or a part of it, and the runs on it.
struct Experiment {
  std::string name;    ///< in study.json
  std::string prefix;  ///< of its files
  Volume volume;       ///< at full resolution
  bool cut = false;    ///< it is a part of the scan
  Settings settings;   ///< of every run, without a crop
  std::vector<PlannedRun> runs;
};

/// Table 1, Figures 3, 6, 7: the scan, or what settings.crop leaves of it, with every s-th slice.
/// @throws InputError  if the range leaves the volume, or a run's volume cannot be used; the
///                     message names the run.
Experiment subsampling_experiment(const Volume& scan, const Settings& settings,
                                  const std::vector<int>& s);

/// Table 2: a part of the scan with every voxel; then with every second one along the first two
/// axes and every s-th slice. The first grid is that of all voxels: settings.stride is not used.
/// @throws InputError  as subsampling_experiment().
Experiment region_experiment(const Volume& scan, const CropRange& region, const Settings& settings,
                             const std::vector<int>& s);

/// The triangles whose points all lie inside the volume's box, `margin` mm away from its faces at
/// least along each of its axes.
TriMesh part_inside(const TriMesh& surface, const Volume& volume, const Vec3& margin);

/// What came of a run.
struct StudyRun {
  PlannedRun plan;
  Volume grid;                  ///< what the run saw, without its samples
  TriMesh surface;              ///< LPS mm; empty: there is none
  int status = 0;               ///< as an exit status
  std::string remark;           ///< why it is not 0
  nlohmann::ordered_json json;  ///< what study.json says of it
  Direction reference_to_surface;
};

/// A run that has no result yet.
StudyRun begun(const PlannedRun& plan);

/// Runs the method.
/// @throws InputError, NumericalError  as mes_amis(), and if there is no surface.
StudyRun execute(const Experiment& experiment, const PlannedRun& plan, const Progress& progress);

/// Adds the distances between the reference and the run's surface, if it has one. Of a cut
/// experiment only what lies inside the run's box, a voxel of the full resolution away from its
/// faces, is measured, from either surface to the whole of the other: at the faces the reference
/// goes on where the run's surface is closed.
/// @param reference  LPS mm, with a triangle inside.
void compare_with(const TriMesh& reference, const Experiment& experiment, StudyRun& run);

/// Marks a run that has no result: not converged, no surface.
void mark_failed(StudyRun& run, const std::string& why);

/// Adds to each run but the first by how much its mean distance (15) differs from the first's.
void add_variations(std::vector<StudyRun>& runs);

}  // namespace mesamis
