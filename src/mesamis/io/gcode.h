// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace mesamis {

/// What a G-code file says of the print in the comments of its slicer. What it does not state, or
/// states in no way that can be read, is empty.
struct GcodeFacts {
  std::string slicer, version;          ///< "PrusaSlicer", "2.5.0"
  std::int64_t layers = 0;              ///< that begin in the file
  std::int64_t lines = 0, bytes = 0;    ///< of the file, comments included
  std::optional<double> print_seconds;  ///< estimated by the slicer
  std::optional<double> filament_mm;    ///< length drawn from the spool
  std::optional<double> filament_cm3, filament_g;
};

/// Reads G-code of PrusaSlicer or of CuraEngine with its final header, see copy_gcode().
///
/// One pass, one line in memory at a time; any bytes are taken.
GcodeFacts read_gcode(std::istream& in);

/// Copies G-code so that the same print is the same bytes: leaves out the date and the number of
/// threads that PrusaSlicer writes into comments.
///
/// CuraEngine begins its file before it knows time and filament, and leaves placeholders.
/// @param header  its lines as CuraEngine logs them at the end, in the place of the comments
///                before ";Generated with"; empty: what the file has.
void copy_gcode(std::istream& in, std::string_view header, std::ostream& out);

/// The lines between "Gcode header after slicing:" and "End of gcode header." in what CuraEngine
/// logs; empty if they are not there.
std::string gcode_header_in(std::string_view log);

/// "1d 2h 3m 4s" in seconds, as PrusaSlicer writes durations; each part may be missing.
std::optional<double> parse_duration(std::string_view text);

}  // namespace mesamis
