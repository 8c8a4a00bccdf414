// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/volume.h"
#include "mesamis/object/tissue.h"
#include "mesamis/restore/object_edge.h"

namespace mesamis::detail::object {

/// The level of a tissue's surface.
struct TissueLevel {
  double level = 0;                  ///< units of the image
  std::optional<SeenObject> seen{};  ///< what was found; nothing: the user gave the level
  ObjectContrast contrast;           ///< at the surface, units of the image
  double uncertainty = 0;  ///< native units, see HalfMaximumLevel; 0 if the user gave the level
  bool measured = false;   ///< false: given by the user, or nothing was found in Tissue::levels
  bool bounded = false;    ///< the half maximum was beyond Tissue::levels, and their end is taken
};

/// Finds the level of a tissue's surface in a whole scan.
///
/// The level is a property of the scan: its kernel, its blur, its contrast agent. Measured in a
/// crop or on every n-th voxel it is another one, not because of noise, but because bones differ:
/// half way between muscle and what the blur leaves of a thin wall it is 130 HU, at a thick shaft
/// 500 HU, and a crop takes another mixture of them. So measure it here once, in the whole scan and
/// at its full resolution, and use it for every crop and every stride of that scan.
///
/// The steps are those of a run without a tissue (find_half_maximum_level() from Tissue::start,
/// then find_object_edge() in the default window), and for bone the result is the same number,
/// unless it lies beyond Tissue::levels.
/// @param image   of the whole scan, in which the tissue is bright (see ImageUnits); usable, see
///                require_usable(); without_surroundings() and without padding where there are such.
/// @param tissue  in the units of the image. For a range LO:HI the level is LO.
/// @return a level within Tissue::levels; where nothing can be measured, Tissue::start.
/// @throws InputError  if there is nothing to measure and no start.
///
/// O(voxels) per iteration, see find_half_maximum_level(); two copies of the samples.
TissueLevel find_tissue_level(const VolumeView& image, const Tissue& tissue);

/// Refuses a tissue whose values mean something in CT alone, in a scan that is none.
/// @throws InputError  if the tissue needs Hounsfield units and the scan has none.
void require_hounsfield(const VolumeView& scan, const Tissue& tissue);

}  // namespace mesamis::detail::object
