// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesamis/rooms.h"

namespace mesamis::detail::printing {

/// What `prusa-slicer --info` states about a surface.
struct PrusaInfo {
  bool manifold = false;        ///< "manifold = yes"
  std::int64_t open_edges = 0;  ///< edges with one triangle
  std::int64_t parts = 0;       ///< connected parts
  double volume = 0;            ///< mm^3
  /// What PrusaSlicer repaired and how often, for example "facets_reversed", 1.
  std::vector<std::pair<std::string, std::int64_t>> repairs{};

  /// Whether PrusaSlicer prints the surface as it is.
  bool sound() const noexcept { return manifold && open_edges == 0 && repairs.empty(); }
};

/// Parses the output of `prusa-slicer --info`.
///
/// @param output  lines of "key = value"; others are skipped.
/// @return manifold is false where the text does not state the contrary.
PrusaInfo parse_prusa_info(std::string_view output);

/// Why PrusaSlicer does not print the surface as it is: "open_edges = 3, facets_reversed = 1".
/// @return empty if it does.
std::string flaws_of(const PrusaInfo& info);

}  // namespace mesamis::detail::printing
