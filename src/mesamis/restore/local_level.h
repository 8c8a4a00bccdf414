// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "mesamis/image/volume.h"
#include "mesamis/restore/object_contrast.h"

/// A level for each place: bones of one scan differ in density, and a level midway between the
/// densest of them and soft tissue loses the others.
namespace mesamis::detail::restore {

/// The level of half maximum at each voxel, against that of the whole object.
struct LocalLevel {
  /// Of the local level over the object's, native units; no samples: there is one level.
  Volume excess{};
  /// 5 % and 95 % quantiles of the local levels at edges, native units; both 0: there is one level.
  std::array<double, 2> range{};
  double edge_share = 0;  ///< voxels at edges over all voxels
  double share = 0;       ///< how much of the local levels counts, 0 (there is one level) to 1
};

/// What is known of a scan whose local levels are looked for.
struct LocalLevelOptions {
  double noise = 0;               ///< standard deviation, native units, >= 0
  std::optional<double> share{};  ///< see LocalLevel; default: as the scatter has it
};

/// Finds the level of half maximum for each place from the edges nearby.
///
/// A voxel lies on an edge where the gradient (of a Gaussian of 0.8 voxels) has its maximum along
/// itself. The sides of the edge are the largest value within two voxels up the gradient and the
/// least within two voxels down. An edge counts if
/// - its contrast, and the bright side over the object's background, are a tenth of the object's
///   contrast and five standard deviations of the noise, or of even tissue where that scatters more;
/// - its dark side is about as dark as the background: skin against air is none, nor is cortical bone
///   against marrow;
/// - a voxel beyond each side the image has gone on by a quarter of the contrast at most, and each
///   side stays on its side of the middle for four voxels.
///
/// The level is the mean of (bright + dark) / 2 over the edges around, weighted by their contrast and
/// a Gaussian of three voxels. Far from all edges it is the object's, which counts as a fiftieth of an
/// edge everywhere but on a flat edge.
///
/// Objects of one density scatter too, by up to 0.06 of the contrast (standard deviation over the
/// edges): then there is one level, also for a part with so few edges that it does not count. From
/// 0.12 on each place has its own; between, a share of it. Parts that are two voxels away from all
/// others and nowhere reach the object's level keep that level: ears, and vessels full of contrast
/// agent, have edges too.
/// @param volume    native values.
/// @param contrast  of the object; its difference is > 0.
/// @param options   noise, and for a part of a scan the share of the whole.
///
/// O(voxels); three copies of the samples. The same bits for any number of threads.
LocalLevel find_local_level(const VolumeView& volume, const ObjectContrast& contrast, double level,
                            const LocalLevelOptions& options);

/// Whether an object is likely bone, whose parts differ in density; the skin and organs have one
/// level.
/// @param level  of its surface, native units.
bool is_likely_bone(const VolumeView& volume, double level);

/// Takes the excess off an image: where its level was the local one, it is that of the object.
/// @param excess  of each voxel of the volume, its unit; no samples: nothing changes.
void take_off(const VolumeView& excess, Volume& volume);

}  // namespace mesamis::detail::restore
