// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "child_process.h"
#include "mesamis/io/gcode.h"

/// The slicers that mesamis drives, as programs: what they are called, how they are told what to
/// do, and what they answer.
namespace mesamis {

/// What can be asked of a print. Layer, infill and perimeters are the paper's.
struct SliceSettings {
  double layer = 0.3;                        ///< mm, all layers, kLayerMin to kNozzle
  double infill = 5;                         ///< percent, 0 to 100
  int perimeters = 2;                        ///< 0 to kPerimetersMax
  bool support = false;                      ///< under what hangs over by more than 50 degrees
  std::array<double, 3> bed{250, 210, 210};  ///< mm, width, depth and height of the print
};

inline constexpr double kLayerMin = 0.02;  // mm
inline constexpr double kNozzle = 0.4;     // mm, diameter
inline constexpr int kPerimetersMax = 100;
inline constexpr double kFilamentDiameter = 1.75;  // mm
inline constexpr double kFilamentDensity = 1.24;   // g/cm^3, PLA
inline constexpr double kShell = 0.8;              // mm, solid layers at top and bottom

/// The files that a slicer reads and writes, in the folder where it runs.
inline constexpr const char* kSurfaceFile = "surface.stl";
inline constexpr const char* kGcodeFile = "print.gcode";

struct Slicer {
  const char* key;      ///< of --slicer
  const char* name;     ///< for people
  const char* program;  ///< looked for in PATH
  const char* package;  ///< that has it on Debian
  /// The command line without the program. The surface stands on the bed: its coordinates are
  /// those of the print, the corner of the bed being the origin.
  std::vector<std::string> (*arguments)(const SliceSettings& settings);
};

/// "prusa" or "cura".
const Slicer& slicer_called(std::string_view key);

/// Where a slicer is.
/// @throws InputError  if it is not there; the message names Debian's package.
std::filesystem::path require_program(const Slicer& slicer);

/// The file from which CuraEngine learns its settings: fdmprinter.def.json in one of the folders
/// of CURA_ENGINE_SEARCH_PATH, or where Debian has it.
/// @throws InputError  if it is nowhere; the message names Debian's package.
std::filesystem::path cura_definition();

/// The words with which a program that failed says why, on one line: its first line that calls
/// itself an error, else its last two that are no progress; "" if there are none. At most 200
/// characters.
std::string failure_line(std::string_view output);

/// What `prusa-slicer --info` says of a surface.
struct PrusaInfo {
  bool manifold = false;
  std::int64_t open_edges = 0, parts = 0;
  double volume = 0;                                            ///< mm^3
  std::vector<std::pair<std::string, std::int64_t>> repairs{};  ///< "facets_reversed", 1

  bool sound() const { return manifold && open_edges == 0 && repairs.empty(); }
};

/// @return manifold is false if the text does not say otherwise.
PrusaInfo parse_prusa_info(std::string_view output);

}  // namespace mesamis
