// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/printing/check_printable.h"
#include "mesamis/printing/gcode.h"
#include "mesamis/printing/slice_settings.h"
#include "mesamis/printing/slicer.h"

namespace mesamis::detail::printing {

struct SliceOptions {
  Slicer slicer = Slicer::kPrusaSlicer;
  SliceSettings settings;
  std::filesystem::path gcode;  ///< file to write; empty: the G-code is read and not kept
  double timeout_seconds = 0;   ///< wall time that each run of a slicer may take, s; 0: no limit
  /// Called with the stage "check"; then with "slice", first before any file is made, and about
  /// ten times a second while a slicer runs. The fraction is 0: slicers do not state it. False
  /// stops the run and kills the slicer.
  Progress progress{};
};

enum class SliceOutcome {
  kSliced,
  kNotPrintable,  ///< see print_flaws_of()
  kDoesNotFit,    ///< larger than the bed, see fits_on()
};

/// The run of a slicer and its cost.
struct SlicerRun {
  std::filesystem::path program;
  std::vector<std::string> arguments;  ///< without the program
  double seconds = 0;                  ///< wall time, s
  double cpu_seconds = 0;              ///< processor time of all its threads, s
  double peak_memory_mb = 0;           ///< MB (10^6 bytes)
};

/// What came of a surface. Unless it was sliced, `run` and `gcode` are empty.
struct SliceResult {
  SliceOutcome outcome = SliceOutcome::kSliced;
  std::size_t triangles = 0;
  Vec3 size;  ///< mm, of the bounding box
  PrintCheck check;
  SlicerRun run;
  GcodeFacts gcode;
  std::vector<std::string> warnings;  ///< one line each
};

/// Turns a closed surface into G-code by PrusaSlicer or CuraEngine, which run as child processes.
///
/// 1. The surface is checked (check_printable()) and placed on the bed (place_on_bed()).
/// 2. It is written as STL, in single precision, into a temporary folder.
/// 3. Where PrusaSlicer is installed, `prusa-slicer --info` checks that file, whichever slicer is
///    chosen. A surface that PrusaSlicer would have to repair is not sliced.
/// 4. The slicer runs in that folder, see run_child() for what it sees of the caller.
/// 5. The G-code is copied without the date and the number of threads (copy_gcode()), so that
///    the same surface gives the same bytes, and read (read_gcode()). Volume and mass of the
///    filament that the slicer does not state follow from its length.
///
/// A result with fewer layers than the height demands, self-intersections, and print time and
/// filament that the slicer did not state are warnings.
/// @param surface  at least one triangle; mm; x to the right of the printer, z up.
/// @param options  settings must be valid, see require_valid().
/// @throws InputError      if the surface is empty or unsound, a setting out of range, the slicer
///                         not installed, or a file cannot be written.
/// @throws NumericalError  if the slicer fails, exceeds the timeout, or writes no layer; the
///                         message has its exit status or signal and its own words. No G-code
///                         is left.
/// @throws Cancelled       if options.progress returned false. Nothing is left.
///
/// O(n log n) and the slicer's own time. The surface is released before the slicer starts. The
/// temporary folder holds 50 bytes per triangle and the G-code.
SliceResult slice_surface(TriMesh surface, const SliceOptions& options);

}  // namespace mesamis::detail::printing
