// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/rooms.h"

/// The slicers, which are programs of their own: names and places.
namespace mesamis::detail::printing {

enum class Slicer { kPrusaSlicer, kCuraEngine };

/// The name of a slicer: "PrusaSlicer" or "CuraEngine".
const char* slicer_name(Slicer slicer);

/// A slicer as it is installed on this machine.
struct InstalledSlicer {
  Slicer slicer = Slicer::kPrusaSlicer;
  std::filesystem::path program;     ///< the executable, an absolute path
  std::filesystem::path definition;  ///< CuraEngine: fdmprinter.def.json; PrusaSlicer: empty
};

/// Searches PATH for a slicer. The file with CuraEngine's settings, fdmprinter.def.json, is
/// searched in the folders of CURA_ENGINE_SEARCH_PATH, then where Debian installs it.
///
/// @throws InputError  if either is not found; the message names Debian's package. Further, as
///                     find_program().
InstalledSlicer require_slicer(Slicer slicer);

/// Searches PATH for the program alone.
/// @return an absolute path; empty if there is none.
/// @throws as find_program().
std::filesystem::path find_slicer(Slicer slicer);

}  // namespace mesamis::detail::printing
