// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"

/// What a user says of the object that is meant.
namespace mesamis {

/// How an object differs from what is around it.
enum class TissueKind {
  kBright,  ///< brighter than its background
  kDark,    ///< darker: looked for in the mirrored() image
  kRange    ///< between two values: looked for in the image within_range()
};

/// A tissue, and where its surface is looked for.
struct Tissue {
  std::string name;  ///< as it is written: "bone", "airway", "300:1200"
  TissueKind kind = TissueKind::kBright;
  Window values{};  ///< of the object itself; HU but for "dark"; an open end is infinite
  Window levels{};  ///< of its surface: the half maximum is looked for between these
  std::optional<double> start{};  ///< level from which the search starts; nothing: Otsu's threshold
  std::string help{};             ///< one line for a user
  bool in_patient = true;         ///< what is outside of the patient is no part of it
  bool hounsfield = true;         ///< the values mean something only in CT

  /// Whether the user named the level, by a range of values: nothing is measured.
  bool level_is_given() const noexcept { return levels.low == levels.high; }
};

/// Reads a tissue: the name of a preset, or a range of values "LO:HI", of which one end may be left
/// out. "LO:" is a bright object whose level is LO, ":HI" a dark one whose level is HI.
/// @param text  native units (HU in CT).
/// @throws InputError  if the text is neither; the message lists what is possible.
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

/// What happens to table, head rest and whatever else is outside of the patient.
enum class SurroundingsRule {
  kRemoveIfPatient,  ///< removed where find_patient() finds a patient
  kRemove,           ///< removed; refused where there is no patient
  kKeep              ///< they stay
};

/// Which object of a scan is meant.
struct ObjectRequest {
  CropRange crop{};                ///< voxels of the scan
  std::optional<Tissue> tissue{};  ///< nothing: whatever is bright
  std::optional<double> level{};   ///< native units of the scan; comes before the tissue's
  bool measure_level = true;       ///< false: nobody needs one but tissues and seeds
  bool has_labels = false;         ///< labels choose the objects: the scan is no label map itself
  SurroundingsRule surroundings = SurroundingsRule::kRemoveIfPatient;
  PaddingRule padding{};             ///< which voxels were not measured
  std::optional<LabelMap> remove{};  ///< what is marked in any of its segments goes
  std::optional<LabelMap> mask{};    ///< what is marked in any of its segments stays
  double margin = 2;                 ///< mm, >= 0, around the mask; see KeepOptions
  std::vector<Vec3> seeds{};         ///< LPS, mm; one: that island alone; more: a part for each
};

}  // namespace mesamis
