// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"

/// The selection of the object in a scan.
namespace mesamis {

/// How an object differs from its surroundings.
enum class TissueKind {
  kBright,  ///< brighter than its background
  kDark,    ///< darker than its background: found in the mirrored() image
  kRange    ///< between two values: found in the image within_range()
};

/// A tissue, and where its surface is searched.
struct Tissue {
  std::string name;  ///< as given: "bone", "airway", "300:1200"
  TissueKind kind = TissueKind::kBright;
  Window values{};  ///< of the object itself; HU but for "dark"; an open end is infinite
  Window levels{};  ///< of its surface: the range in which the half maximum is searched
  std::optional<double> start{};  ///< initial level of the search; none: Otsu's threshold
  std::string help{};             ///< one line for a user
  bool in_patient = true;         ///< only inside the patient
  bool hounsfield = true;         ///< the values are HU, for CT alone

  /// Whether a range of values gives the level, so that it is not measured.
  bool level_is_given() const noexcept { return levels.low == levels.high; }
};

/// Reads a tissue: the name of a preset, or a range of values "LO:HI" with one end optional. "LO:"
/// is a bright object whose level is LO, ":HI" a dark one whose level is HI.
/// @param text  native units (HU in CT).
/// @throws InputError  if the text is neither; the message lists the tissues.
Tissue parse_tissue(std::string_view text);

/// Which voxels count as padding.
struct PaddingRule {
  bool search = true;             ///< as find_padding() does; false: none is padding
  std::optional<double> value{};  ///< native units: all voxels of this value, without a search
};

/// Reads "auto" (the search), "none" or a number.
/// @return native units.
/// @throws InputError  for any other text.
///
/// O(1).
PaddingRule parse_padding(std::string_view text);

/// The treatment of table, head rest and everything else outside the patient.
enum class SurroundingsRule {
  kRemoveIfPatient,  ///< removed where find_patient() finds a patient
  kRemove,           ///< removed; refused where there is no patient
  kKeep              ///< kept
};

/// The object to take from a scan.
struct ObjectRequest {
  CropRange crop{};                ///< voxels of the scan
  std::optional<Tissue> tissue{};  ///< none: everything bright
  std::optional<double> level{};   ///< native units of the scan; overrides the tissue's
  bool measure_level = true;       ///< false: measure one for tissues and seeds alone
  bool local_level = false;        ///< places of bone may differ in their level, see LocalLevel
  bool has_labels = false;         ///< labels choose the objects: the scan is no label map itself
  SurroundingsRule surroundings = SurroundingsRule::kRemoveIfPatient;
  PaddingRule padding{};             ///< which voxels were not measured
  std::optional<LabelMap> remove{};  ///< voxels of its segments are removed
  std::optional<LabelMap> mask{};    ///< voxels of its segments are kept
  double margin = 2;                 ///< mm, >= 0, around the mask; see KeepOptions
  std::vector<Vec3> seeds{};         ///< LPS, mm; one: that island; several: a part for each
};

}  // namespace mesamis
