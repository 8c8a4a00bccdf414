// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"
#include "mesamis/object/known_level.h"
#include "mesamis/object/mirror.h"
#include "mesamis/object/object_request.h"
#include "mesamis/object/patient.h"
#include "mesamis/object/voxel_distance.h"
#include "mesamis/restore/restore.h"

/// From a scan and what a user says of the object to an image that shows this object alone.
namespace mesamis::detail::object {

/// Padding that was filled.
struct FilledPadding {
  std::size_t voxels = 0;
  double value = 0;   ///< that of most of it, native units
  double filled = 0;  ///< what it is now, native units
};

/// The image of an object, and how it was made.
struct ChosenObject {
  Volume volume;                          ///< the object is brighter than what is around it
  TissueKind kind = TissueKind::kBright;  ///< dark: mirrored(); range: within_range()
  bool hounsfield = false;                ///< the scan, before anything changed, was in HU
  std::string tissue;                     ///< its name; empty: none was asked for
  std::optional<KnownLevel> level;        ///< nothing: the run measures it
  CropRange crop;                         ///< the part of the scan that the volume is
  std::optional<ScanMeasure> scan;        ///< of a crop of CT: how the whole scan is restored
  std::vector<Surroundings> removed;      ///< from the whole scan
  std::optional<FilledPadding> padding;   ///< of the whole scan
  VoxelMask unmeasured;                   ///< the padding, by voxels of the volume; empty: none
  std::optional<LabelMap> parts;          ///< of two seeds and more, see split_at_seeds()
  bool alone = false;                     ///< one seed: the volume shows a single island
  std::vector<std::string> notes;         ///< one line each: what was done unasked
  std::vector<std::string> warnings;      ///< one line each: what may not be what was meant

  /// Whether its level may differ from place to place: that of other tissues stays in their range.
  bool may_be_bone() const { return tissue.empty() || tissue == "bone"; }

  /// From the units of the scan to those of the volume, and back.
  ImageUnits units() const noexcept { return ImageUnits(kind); }
};

/// Makes the image of the object that is meant.
///
/// In this order: padding is filled (CT: with air, -1000 HU; else with the value that a twentieth
/// of the other samples do not exceed); what is outside of the patient goes, see
/// without_surroundings(), and for a dark tissue of the body the air around it too; what is marked
/// to be removed falls to the median of what is around it (for a dark object or a range of values
/// later, in the cropped image); a dark object or a range of values becomes bright; the level is
/// measured in the whole scan; the scan is cropped; what lies beyond the mask goes; at the level,
/// islands without a seed go, and several seeds split what touches.
///
/// Noise, blur, window and contrast of a crop of CT are those of the whole scan.
///
/// A level is measured here for a tissue, in CT for a crop, a mask or seeds, and in other scans for
/// a mask or seeds, there in the crop. Without a tissue it is the number that a run finds in the
/// whole scan. Where nothing of all this is asked for, and there is no padding and nothing around a
/// patient, the samples do not change.
///
/// @param scan     usable, see require_usable(); taken over, pass it with std::move() to save the
///                 copy.
/// @param request  see there.
/// @throws InputError  if the crop, a seed or a label map does not fit the scan, a tissue needs
///                     Hounsfield units, a body that is to be removed is not found, or as
///                     find_tissue_level() and split_at_seeds().
///
/// O(voxels), as the steps asked for; one or two copies of the samples at a time, and about 30
/// bytes per voxel that find_patient() looks at.
ChosenObject choose_object(Volume scan, const ObjectRequest& request);

/// Finds out whether choose_object() would leave a scan's samples as they are, so that the scan can
/// be read in place.
/// @param scan  usable, see require_usable().
/// @return what choose_object() returns, but for a volume without samples; nothing where it would
///         change or crop them, or is asked to look for more than a level.
/// @throws InputError  as choose_object().
///
/// O(voxels); no copy of the samples.
std::optional<ChosenObject> choose_in_place(const VolumeView& scan, const ObjectRequest& request);

/// Says in words what a surface may show instead of what was meant: the skin, where neither tissue
/// nor level were given, or the border of what the scanner measured.
/// @param level  of the surface, units of the scan, as run_on_object() tells it.
/// @return one line each.
std::vector<std::string> surface_warnings(const ChosenObject& object, double level);

/// The same where the samples of the object's image lie elsewhere, see choose_in_place().
std::vector<std::string> surface_warnings(const ChosenObject& object, const VolumeView& image,
                                          double level);

}  // namespace mesamis::detail::object
