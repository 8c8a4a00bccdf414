// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/method/settings.h"
#include "mesamis/rooms.h"

/// Experiments that measure how the surface depends on the resolution of the scan: section 5 of the
/// paper, on any scan with a reference surface.
namespace mesamis::detail::study {

/// One run of the method on a subsampled volume.
struct PlannedRun {
  std::string name;                      ///< "s4", "region_full": unique in its study
  int s = 1;                             ///< every s-th slice along the grid's third axis is kept
  std::array<Index, 3> stride{1, 1, 1};  ///< every stride-th voxel is kept, per axis
  bool baseline = false;  ///< full resolution: the other runs' distances are compared with its own
};

/// A scan, or a part of it, and the runs on it.
struct Experiment {
  std::string name;      ///< "subsampling" or "region"
  std::string prefix;    ///< of the names of its tables and diagrams
  Volume volume;         ///< at full resolution, native units
  bool cropped = false;  ///< whether the volume is a part of the scan
  Settings settings;     ///< of every run; its crop is already done
  std::vector<PlannedRun> runs;
};

/// Plans the runs of Table 1 and Figures 3, 6 and 7: the scan, or the part of it that settings.crop
/// keeps, with every s-th slice.
/// @param scan      native units.
/// @param settings  valid, see require_valid().
/// @param s         steps between slices that are kept, in voxels, >= 1, each once.
/// @return runs "sN" in the order of `s`.
/// @throws InputError  if the range leaves the volume, or the volume of a run cannot be used; the
///                     message names the run.
///
/// O(voxels) time for each run; memory of two copies of the samples.
Experiment subsampling_experiment(const Volume& scan, const Settings& settings,
                                  std::span<const int> s);

/// Plans the runs of Table 2: a part of the scan with every voxel, then with every second voxel
/// along the first two axes and every s-th slice. The stride of every run's first grid is 1,
/// whatever settings.stride says.
/// @param scan      native units.
/// @param region    the part, in voxels.
/// @param settings  valid; settings.crop is not used.
/// @param s         as subsampling_experiment().
/// @return the baseline "region_full", then "region_sN" in the order of `s`.
/// @throws InputError  as subsampling_experiment(). Cost as there.
Experiment region_experiment(const Volume& scan, const CropRange& region, const Settings& settings,
                             std::span<const int> s);

}  // namespace mesamis::detail::study
