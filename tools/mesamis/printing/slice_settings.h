// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/printing/print_bed.h"

namespace mesamis::detail::printing {

inline constexpr double kLayerMin = 0.02;          // mm
inline constexpr double kNozzle = 0.4;             // mm, diameter
inline constexpr int kPerimetersMax = 100;         // lines
inline constexpr double kFilamentDiameter = 1.75;  // mm
inline constexpr double kFilamentDensity = 1.24;   // g/cm^3, PLA
inline constexpr double kShell = 0.8;              // mm, solid layers at top and bottom

/// What can be chosen about a print. Layer, infill and perimeters are the paper's.
struct SliceSettings {
  double layer = 0.3;    ///< mm, height of every layer, kLayerMin to kNozzle
  double infill = 5;     ///< percent, 0 to 100
  int perimeters = 2;    ///< lines around each layer, 0 to kPerimetersMax
  bool support = false;  ///< under overhangs of more than 50 degrees from the vertical
  PrintBed bed;          ///< mm
};

/// @throws InputError  if a setting is out of its range; the message names it.
void require_valid(const SliceSettings& settings);

}  // namespace mesamis::detail::printing
