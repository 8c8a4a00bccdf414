// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/object/voxel_distance.h"

namespace mesamis::detail::object {

/// Something beside the patient.
struct Surroundings {
  std::string what;  ///< "table or head rest", "other objects"
  double mm3 = 0;    ///< its volume, > 0
};

/// The patient in a CT scan.
struct Patient {
  VoxelMask mask;                     ///< 1 within the patient, lungs and airways included; else 0
  double mm3 = 0;                     ///< volume of the mask
  double grain = 0;                   ///< mm: the mask is as coarse as this
  std::vector<Surroundings> removed;  ///< what is not in the mask and no air; the largest first
};

/// Finds the patient's body in a CT scan. Where it is in doubt it keeps: better a piece of a table
/// too much than a finger too little.
///
/// On every n-th voxel, so that they are about 2 mm apart:
/// - Solid is all above -300 HU, and what that encloses in an axial slice: sinuses, airways, lungs.
///   Sheets of less than 6 mm enclose nothing, else the gap between patient and table would count.
/// - Solid parts of which half is soft tissue (-200 to 200 HU) are opened by a ball of 6 mm, which
///   cuts off what touches the patient along less than 12 mm. The largest part is the body, and so
///   are others of at least a hundredth of it (arms, legs).
/// - What the opening took is given back if it hangs on and is no longer than 100 mm (ears, nose,
///   fingers), or lies in a hollow of the body into which no ball of 15 mm fits.
/// - What the body encloses, in space or in an axial slice, is inside, and so is a gap at the
///   border of the scan that is lung (-950 to -300 HU in its median).
///
/// Of what is left out, islands that reach through at least half of the slices are called table or
/// head rest.
/// @param volume  finite samples.
/// @return nothing unless the scan is in Hounsfield units, and half of its largest part is soft
///         tissue: MR, micro-CT and dry bones have none. Nothing either where what would be left
///         out is both more, and more of what is brighter than 250 HU: a dry bone beside foam.
///
/// O(voxels); about 30 bytes per voxel that is looked at, and the mask.
std::optional<Patient> find_patient(const VolumeView& volume);

/// Replaces what is bright outside of the body by air, see kept_to(): within the mask's grain of
/// the body nothing changes.
/// @param volume  native units; taken over, pass it with std::move() to save the copy.
/// @param body    of this volume.
/// @return native units.
/// @throws InputError  if the mask does not fit the volume or is empty.
///
/// O(voxels), as kept_to().
Volume without_surroundings(Volume volume, const Patient& patient);

}  // namespace mesamis::detail::object
