// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/slice_surface.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/printing/child_process.h"
#include "mesamis/printing/slicer_arguments.h"
#include "mesamis/printing/slicer_log.h"
#include "mesamis/printing/temporary_folder.h"
#include "mesamis/shape_files/surface_files.h"

namespace mesamis::detail::printing {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kLayersMissed = 2;  // a flat top or bottom may account for as many

void report_stage(const SliceOptions& options, const char* stage) {
  if (options.progress && !options.progress(stage, 0)) throw Cancelled();
}

/// A run in the folder that ends when the caller's progress function says so.
ChildRun run_in(const fs::path& folder, const fs::path& program,
                const std::vector<std::string>& arguments, const SliceOptions& options) {
  ChildRequest request{program, arguments, folder};
  request.timeout_seconds = options.timeout_seconds;
  return run_child(request, [&options] {  //
    return options.progress && !options.progress("slice", 0);
  });
}

/// "exit status 3"; empty for a program that says it succeeded.
std::string failure_of(const ChildRun& run) {
  switch (run.end) {
    case ChildEnd::kTimeout:
      return "none before the timeout";
    case ChildEnd::kOutputLimit:
      return "more messages than are read";
    default:
      if (run.status < 0) return "signal " + std::to_string(-run.status);
      return run.status > 0 ? "exit status " + std::to_string(run.status) : "";
  }
}

[[noreturn]] void fail(const std::string& expected, const std::string& found, const ChildRun& run) {
  const std::string line = failure_line(run.output);
  throw NumericalError(expected + ", found " + found + (line.empty() ? "" : ": " + line));
}

/// PrusaSlicer's check of the file that is sliced; none where it is not installed.
std::optional<PrusaInfo> check_by_prusa(const fs::path& folder, const SliceOptions& options) {
  const fs::path program = find_slicer(Slicer::kPrusaSlicer);
  if (program.empty()) return std::nullopt;
  const ChildRun run = run_in(
      folder, program, {"--datadir", "prusa", "--loglevel", "1", "--info", kSurfaceFile}, options);
  const std::string failure = failure_of(run);
  if (!failure.empty()) fail("prusa-slicer --info: expected exit status 0", failure, run);
  return parse_prusa_info(run.output);
}

/// Runs the slicer on the file in the folder.
ChildRun run_slicer(const fs::path& folder, const SliceOptions& options, SlicerRun& report) {
  const InstalledSlicer slicer = require_slicer(options.slicer);
  report.program = slicer.program;
  report.arguments = slicer_arguments(slicer, options.settings);
  ChildRun run = run_in(folder, report.program, report.arguments, options);
  std::string failure = failure_of(run);
  if (failure.empty() && !fs::exists(folder / kGcodeFile)) failure = "none";
  if (!failure.empty()) {
    fail(slicer_name(options.slicer) + std::string(": expected G-code"), failure, run);
  }
  report.seconds = run.seconds;
  report.cpu_seconds = run.cpu_seconds;
  report.peak_memory_mb = run.peak_memory_mb;
  return run;
}

/// Copies the G-code to its place, with CuraEngine's header where there is one.
void copy_file(const fs::path& from, const fs::path& to, const std::string& header) {
  std::ifstream in(from, std::ios::binary);
  std::ofstream out(to, std::ios::binary);
  copy_gcode(in, header, out);
  out.close();
  if (!out) throw InputError(to.string() + ": cannot be written; is the disk full?");
}

/// Volume and mass of the filament, where the slicer states its length alone.
void complete(GcodeFacts& facts) {
  if (facts.filament_mm && !facts.filament_cm3) {
    const double section = std::numbers::pi / 4 * kFilamentDiameter * kFilamentDiameter;
    facts.filament_cm3 = *facts.filament_mm * section / 1000;
  }
  if (facts.filament_cm3 && !facts.filament_g) {
    facts.filament_g = *facts.filament_cm3 * kFilamentDensity;
  }
}

void warn_of_missing_layers(const SliceSettings& settings, SliceResult& result) {
  const auto expected = static_cast<std::int64_t>(std::llround(result.size.z / settings.layer));
  if (result.gcode.layers + kLayersMissed >= expected) return;
  result.warnings.push_back("the G-code has " + std::to_string(result.gcode.layers) +
                            " layers, expected about " + std::to_string(expected) +
                            " for a height of " + std::to_string(result.size.z) + " mm");
}

/// Slices the file in the folder and brings the G-code to `to`.
void slice_in(const fs::path& folder, const SliceOptions& options, const fs::path& to,
              SliceResult& result) {
  const ChildRun run = run_slicer(folder, options, result.run);
  const bool is_cura = options.slicer == Slicer::kCuraEngine;
  const std::string header = is_cura ? gcode_header_in(run.output) : "";
  copy_file(folder / kGcodeFile, to, header);
  std::ifstream copy(to, std::ios::binary);
  result.gcode = read_gcode(copy);
  if (is_cura && header.empty()) {  // the file has placeholders
    result.gcode.print_seconds = result.gcode.filament_mm = std::nullopt;
    result.warnings.emplace_back("CuraEngine logged no header: time and filament are not known");
  }
  complete(result.gcode);
  if (result.gcode.layers == 0) {
    throw NumericalError(std::string(slicer_name(options.slicer)) +
                         ": expected layers in its G-code, found none");
  }
  warn_of_missing_layers(options.settings, result);
}

/// Whether the surface may go on to the slicer; sets the outcome.
bool passes(const SliceOptions& options, SliceResult& result) {
  if (!print_flaws_of(result.check).empty()) {
    result.outcome = SliceOutcome::kNotPrintable;
  } else if (!fits_on(options.settings.bed, result.size)) {
    result.outcome = SliceOutcome::kDoesNotFit;
  }
  return result.outcome == SliceOutcome::kSliced;
}

void warn_of_intersections(SliceResult& result) {
  if (result.check.self_intersections == 0) return;
  result.warnings.push_back(std::to_string(result.check.self_intersections) +
                            " pairs of triangles meet; the slicer unites what overlaps");
}

}  // namespace

SliceResult slice_surface(TriMesh surface, const SliceOptions& options) {
  require_valid(options.settings);
  require_slicer(options.slicer);
  report_stage(options, "check");
  SliceResult result;
  PlacedSurface placed = place_on_bed(std::move(surface), options.settings.bed);
  result.triangles = placed.surface.triangles.size();
  result.size = placed.size;
  result.check = check_printable(placed.surface);
  if (!passes(options, result)) return result;
  warn_of_intersections(result);
  report_stage(options, "slice");
  // A place that cannot be written to is refused before the work.
  std::optional<AtomicFile> output;
  if (!options.gcode.empty()) output.emplace(options.gcode);
  const TemporaryFolder folder("slice");
  write_surface(folder.path() / kSurfaceFile, placed.surface);
  placed.surface = {};  // a child process begins with the memory that is held here
  result.check.prusa = check_by_prusa(folder.path(), options);
  if (!passes(options, result)) return result;
  slice_in(folder.path(), options, output ? output->temporary_path() : folder.path() / "copy.gcode",
           result);
  report_stage(options, "slice");
  if (output) output->commit();
  return result;
}

}  // namespace mesamis::detail::printing
