// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "mesamis/rooms.h"

namespace mesamis::detail::printing {

/// What a G-code file states about the print in the comments of its slicer. Values that it does not
/// state, or that cannot be read, are empty.
struct GcodeFacts {
  std::string slicer, version;          ///< "PrusaSlicer", "2.5.0"
  std::int64_t layers = 0;              ///< layer changes in the file
  std::int64_t lines = 0, bytes = 0;    ///< of the file, comments included
  std::optional<double> print_seconds;  ///< s, estimated by the slicer
  std::optional<double> filament_mm;    ///< mm, length of filament
  std::optional<double> filament_cm3;   ///< cm^3
  std::optional<double> filament_g;     ///< g
};

/// Reads G-code of PrusaSlicer, or of CuraEngine with its final header (see copy_gcode()).
///
/// @param in  any bytes; read to the end.
/// , unless the stream itself throws (std::ios::exceptions()).
///
/// O(bytes), one pass; memory: the longest line.
GcodeFacts read_gcode(std::istream& in);

/// Copies G-code so that the same print gives the same bytes: the date and the number of threads
/// that PrusaSlicer writes into comments are left out, and every line ends with a newline.
///
/// @param header  lines that replace the comments before ";Generated with". CuraEngine writes its
///                header before it knows time and filament, and logs the final one, see
///                gcode_header_in(). Empty: the header of the file is kept.
/// , unless a stream itself throws (std::ios::exceptions()). Errors of the streams
///         are left in their states.
///
/// O(bytes), one pass; memory: the longest line.
void copy_gcode(std::istream& in, std::string_view header, std::ostream& out);

/// Finds the final header in the log of CuraEngine: the lines between "Gcode header after
/// slicing:" and "End of gcode header.".
/// @return the lines with their newlines; empty if they are not there.
std::string gcode_header_in(std::string_view log);

/// Parses a duration as PrusaSlicer writes it: "1d 2h 3m 4s"; each part may be missing.
/// @return seconds; none if the text is no duration.
std::optional<double> parse_duration(std::string_view text);

}  // namespace mesamis::detail::printing
