// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "mesamis/image/grey_values.h"
#include "mesamis/image/volume.h"

/// Tissues by their values in CT: what is meant by "bone" or "airway".
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
  bool in_body = true;            ///< what is outside of the patient is no part of it
  bool hounsfield = true;         ///< the values mean something only in CT

  /// Whether the user named the level, by a range of values: nothing is measured.
  bool level_is_given() const noexcept { return levels.low == levels.high; }
};

/// The presets, in the order in which help lists them: bone, teeth, soft, skin, lung, airway,
/// vessel, dark.
std::span<const Tissue> tissue_table() noexcept;

/// Reads a tissue: the name of a preset, or a range of values "LO:HI", of which one end may be left
/// out. "LO:" is a bright object whose level is LO, ":HI" a dark one whose level is HI.
/// @param text  native units (HU in CT).
/// @throws InputError  if the text is neither; the message lists what is possible.
Tissue parse_tissue(std::string_view text);

/// Suggests the tissue that a user of this scan most likely means.
/// @param volume  at least one sample, all finite.
/// @return bone for CT with at least a thousandth of the voxels above 200 HU, skin for other CT,
///         nothing for other scans.
std::optional<Tissue> suggested_tissue(const VolumeView& volume);

/// Names the tissue that a level shows the surface of, for a word in a report.
/// @param volume  at least one sample, all finite.
/// @param level   native units.
/// @return "skin", "soft tissue", "vessels or spongy bone", "bone" or "metal"; empty if the scan is
///         not CT, or nothing crosses the level.
std::string surface_at_level(const VolumeView& volume, double level);

}  // namespace mesamis
