// SPDX-License-Identifier: Apache-2.0
// mesamis slice: G-code of a closed surface by a slicer, and what the print takes.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>

#include "arguments.h"
#include "commands.h"
#include "interrupt.h"
#include "json_file.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/io/atomic_file.h"
#include "mesamis/io/read_volume.h"
#include "mesamis/io/surface_files.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/unused_points.h"
#include "outputs.h"
#include "print_gate.h"
#include "private_folder.h"
#include "process.h"
#include "slicers.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::int64_t kLayersMissed = 2;  // that a flat top or bottom may account for

struct SliceCommand {
  fs::path surface, output, report;
  std::string slicer;
  SliceSettings settings;
};

/// The surface where it is printed, and what was found on the way there.
struct Placed {
  TriMesh surface;  ///< on the bed, in its middle; the corner of the bed is the origin
  std::size_t triangles = 0;
  Vec3 size;  ///< mm
  PrintGate gate;
};

/// What a slicer made of it.
struct Sliced {
  fs::path program;
  std::vector<std::string> arguments;
  ChildRun run;
  GcodeFacts facts;
};

std::string size_text(double x, double y, double z) {
  std::ostringstream text;
  text << x << " x " << y << " x " << z << " mm";
  return text.str();
}

void require_fit(const SliceCommand& command, const Vec3& size) {
  const auto& bed = command.settings.bed;
  if (size.x <= bed[0] && size.y <= bed[1] && size.z <= bed[2]) return;
  throw InputError(command.surface.string() + ": expected a surface that fits on a bed of " +
                   size_text(bed[0], bed[1], bed[2]) + " (width x depth x height), found " +
                   size_text(size.x, size.y, size.z) + "; --bed X,Y,Z gives another bed");
}

Placed place(TriMesh surface, const std::array<double, 3>& bed) {
  const Box box = bounding_box(without_unused_points(surface).points);
  const Vec3 middle = 0.5 * (box.lo + box.hi);
  const Vec3 shift{bed[0] / 2 - middle.x, bed[1] / 2 - middle.y, -box.lo.z};
  for (Vec3& p : surface.points) p += shift;
  Placed placed{std::move(surface), 0, box.extent(), {}};
  placed.triangles = placed.surface.triangles.size();
  return placed;
}

ordered_json settings_json(const SliceSettings& settings) {
  return {{"layer_mm", settings.layer},
          {"infill_percent", settings.infill},
          {"perimeters", settings.perimeters},
          {"support", settings.support},
          {"bed_mm", settings.bed},
          {"shell_mm", kShell},
          {"nozzle_mm", kNozzle},
          {"filament_diameter_mm", kFilamentDiameter},
          {"filament_density_g_cm3", kFilamentDensity}};
}

ordered_json base_report(const SliceCommand& command, const Placed& placed) {
  ordered_json report;
  report["program"] = program_json();
  report["input"] = {{"path", command.surface.string()},
                     {"sha256", sha256(command.surface)},
                     {"triangles", placed.triangles},
                     {"size_mm", vec_json(placed.size)}};
  report["settings"] = settings_json(command.settings);
  report["gate"] = gate_json(placed.gate);
  return report;
}

ordered_json known(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

void write_report(const SliceCommand& command, const Placed& placed, const Sliced& sliced) {
  const GcodeFacts& facts = sliced.facts;
  ordered_json report = base_report(command, placed);
  report["slicer"] = {{"name", slicer_called(command.slicer).name},
                      {"version", facts.version},
                      {"path", sliced.program.string()},
                      {"arguments", sliced.arguments}};
  report["layers"] = facts.layers;
  report["gcode_lines"] = facts.lines;
  report["gcode_bytes"] = facts.bytes;
  report["estimated_print_seconds"] = known(facts.print_seconds);
  report["filament_mm"] = known(facts.filament_mm);
  report["filament_cm3"] = known(facts.filament_cm3);
  report["filament_g"] = known(facts.filament_g);
  report["seconds"] = sliced.run.seconds;
  report["cpu_seconds"] = sliced.run.cpu_seconds;
  report["peak_memory_mb"] = sliced.run.peak_memory_mb;
  report["seconds_total"] = wall_seconds();
  write_json(command.report, report);
}

/// @return whether the surface may be sliced; if not, says why and reports the gate alone.
bool pass(const SliceCommand& command, const Placed& placed) {
  const std::string flaw = print_flaw(placed.gate);
  if (flaw.empty()) return true;
  if (!command.report.empty()) write_json(command.report, base_report(command, placed));
  log_error(command.surface.string() + ": expected a closed 2-manifold that faces outward, found " +
            flaw);
  return false;
}

/// Asks PrusaSlicer, where it is installed, about the very file that is sliced.
void ask_prusa(const fs::path& folder, PrintGate& gate) {
  const fs::path program = find_program(slicer_called("prusa").program);
  if (program.empty()) return;
  const ChildRun run = run_child(
      {program, {"--datadir", "prusa", "--loglevel", "1", "--info", kSurfaceFile}, folder});
  if (run.status != 0) {
    throw NumericalError("prusa-slicer --info: expected exit status 0, found " +
                         std::to_string(run.status) + ": " + failure_line(run.output));
  }
  gate.prusa = parse_prusa_info(run.output);
}

void require_success(const Slicer& slicer, const ChildRun& run, const fs::path& gcode) {
  std::string found;
  if (run.status < 0) found = "signal " + std::to_string(-run.status);
  if (run.status > 0) found = "exit status " + std::to_string(run.status);
  if (found.empty() && !fs::exists(gcode)) found = "none";
  if (found.empty()) return;
  const std::string line = failure_line(run.output);
  throw NumericalError(std::string(slicer.name) + ": expected G-code, found " + found +
                       (line.empty() ? "" : ": " + line));
}

/// Filament as volume and weight, where the slicer gives its length alone.
void complete(GcodeFacts& facts) {
  if (facts.filament_mm && !facts.filament_cm3) {
    const double section = std::numbers::pi / 4 * kFilamentDiameter * kFilamentDiameter;
    facts.filament_cm3 = *facts.filament_mm * section / 1000;
  }
  if (facts.filament_cm3 && !facts.filament_g) {
    facts.filament_g = *facts.filament_cm3 * kFilamentDensity;
  }
}

/// Copies the G-code to its place and reads it there.
GcodeFacts deliver(const fs::path& from, const fs::path& to, const ChildRun& run, bool is_cura) {
  const std::string header = is_cura ? gcode_header_in(run.output) : "";
  std::ifstream in(from, std::ios::binary);
  std::ofstream out(to, std::ios::binary);
  copy_gcode(in, header, out);
  out.close();
  if (!out) throw InputError(to.string() + ": cannot be written; is the disk full?");
  std::ifstream copy(to, std::ios::binary);
  GcodeFacts facts = read_gcode(copy);
  if (is_cura && header.empty()) {  // what stands there are placeholders
    facts.print_seconds = facts.filament_mm = std::nullopt;
    log_warning("CuraEngine logged no header: time and filament are not known");
  }
  complete(facts);
  return facts;
}

void warn_of_missing_layers(const GcodeFacts& facts, double height, double layer) {
  const auto expected = static_cast<std::int64_t>(std::llround(height / layer));
  if (facts.layers + kLayersMissed >= expected) return;
  log_warning("the G-code has " + std::to_string(facts.layers) + " layers, expected about " +
              std::to_string(expected) + " for a height of " + std::to_string(height) + " mm");
}

/// Slices the surface in the folder and copies the G-code to `to`.
Sliced slice_in(const fs::path& folder, const SliceCommand& command, const fs::path& to) {
  const Slicer& slicer = slicer_called(command.slicer);
  Sliced sliced{require_program(slicer), slicer.arguments(command.settings), {}, {}};
  log_info(std::string("slicing with ") + slicer.name);
  sliced.run = run_child({sliced.program, sliced.arguments, folder});
  require_success(slicer, sliced.run, folder / kGcodeFile);
  sliced.facts = deliver(folder / kGcodeFile, to, sliced.run, command.slicer == "cura");
  if (sliced.facts.layers == 0) {
    throw NumericalError(std::string(slicer.name) + ": expected layers in its G-code, found none");
  }
  return sliced;
}

std::string duration_text(double seconds) {
  const auto minutes = std::llround(seconds / 60);
  if (minutes == 0) return std::to_string(std::llround(seconds)) + " s";
  const std::string rest = std::to_string(minutes % 60) + " min";
  return minutes < 60 ? rest : std::to_string(minutes / 60) + " h " + rest;
}

void print_result(const SliceCommand& command, const Sliced& sliced) {
  const GcodeFacts& facts = sliced.facts;
  std::cout << slicer_called(command.slicer).name << " " << facts.version << ": " << facts.layers
            << " layers, " << facts.lines << " lines (" << 1e-6 * static_cast<double>(facts.bytes)
            << " MB) of G-code";
  if (facts.print_seconds) std::cout << "; print " << duration_text(*facts.print_seconds);
  if (facts.filament_mm && facts.filament_g) {
    std::cout << ", filament " << *facts.filament_mm / 1000 << " m, " << *facts.filament_g << " g";
  }
  std::cout << "; sliced in " << sliced.run.seconds << " s, " << sliced.run.peak_memory_mb
            << " MB\n";
}

/// All that is to be known before anything is computed.
void require_all(const SliceCommand& command) {
  if (!command.output.empty()) require_output(command.output, {".gcode"}, "--output");
  if (!command.report.empty()) require_output(command.report, {".json"}, "--report");
  require_program(slicer_called(command.slicer));
  if (command.slicer == "cura") cura_definition();
}

int run_slice(const SliceCommand& command) {
  require_all(command);
  Placed placed = place(read_surface(command.surface), command.settings.bed);
  placed.gate = check_for_print(placed.surface);
  if (!pass(command, placed)) return kExitNotClosed;
  require_fit(command, placed.size);
  if (placed.gate.self_intersections > 0) {
    log_warning(command.surface.string() + ": " + std::to_string(placed.gate.self_intersections) +
                " pairs of triangles meet; the slicer unites what overlaps");
  }
  // A place that cannot be written to shows now, not after the work.
  std::optional<AtomicFile> output;
  if (!command.output.empty()) output.emplace(command.output);
  const PrivateFolder folder("slice");
  write_surface(folder.path() / kSurfaceFile, placed.surface);
  placed.surface = {};  // a child begins with what is held here
  ask_prusa(folder.path(), placed.gate);
  if (!pass(command, placed)) return kExitNotClosed;
  const Sliced sliced = slice_in(folder.path(), command,
                                 output ? output->temporary_path() : folder.path() / "copy.gcode");
  warn_of_missing_layers(sliced.facts, placed.size.z, command.settings.layer);
  check_interrupted();
  if (output) output->commit();
  if (!command.report.empty()) write_report(command, placed, sliced);
  print_result(command, sliced);
  return kExitDone;
}

/// A number in a range, whole if it must be; a sign of percent may follow where it can.
struct NumberOption {
  const char* name;
  double lowest, highest;
  const char* unit;
  bool whole = false;
};

double number_in(const NumberOption& option, std::string text) {
  if (option.unit == std::string("%") && !text.empty() && text.back() == '%') text.pop_back();
  double value = 0;
  const bool valid = parse_number(text, value) && value >= option.lowest &&
                     value <= option.highest && (!option.whole || value == std::floor(value));
  if (valid) return value;
  std::ostringstream message;
  message << "expected " << (option.whole ? "a whole number from " : "") << option.lowest << " to "
          << option.highest << option.unit << ", found '" << text << "'";
  throw CLI::ValidationError(option.name, message.str());
}

std::array<double, 3> bed_of(const std::string& text, const std::array<double, 3>& usual) {
  const bool has_height = std::count(text.begin(), text.end(), ',') == 2;
  const std::vector<double> numbers = parse_numbers(text, has_height ? 3 : 2, "--bed");
  const std::array<double, 3> bed{numbers[0], numbers[1], has_height ? numbers[2] : usual[2]};
  for (const double length : bed) {
    if (!(length >= 1 && length <= 1e4)) {
      throw CLI::ValidationError("--bed",
                                 "expected lengths from 1 to 10000 mm, found '" + text + "'");
    }
  }
  return bed;
}

void add_print_options(CLI::App& sub, const std::shared_ptr<SliceCommand>& command) {
  SliceSettings& settings = command->settings;  // lives as long as `command`
  auto add = [&sub, command](const NumberOption& option, const char* help, auto set) {
    sub.add_option_function<std::string>(
        option.name,
        [command, option, set](const std::string& text) {
          set(command->settings, number_in(option, text));
        },
        help);
  };
  add({"--layer", kLayerMin, kNozzle, " mm (the nozzle)"}, "Height of a layer, mm (default 0.3)",
      [](SliceSettings& s, double value) { s.layer = value; });
  add({"--infill", 0, 100, "%"}, "Density of the infill, percent (default 5)",
      [](SliceSettings& s, double value) { s.infill = value; });
  add({"--perimeters", 0, kPerimetersMax, "", true}, "Lines around each layer (default 2)",
      [](SliceSettings& s, double value) { s.perimeters = static_cast<int>(value); });
  sub.add_flag("--support", settings.support, "Support what hangs over");
  sub.add_option_function<std::string>(
      "--bed",
      [command](const std::string& text) {
        command->settings.bed = bed_of(text, SliceSettings().bed);
      },
      "Width, depth[, height] of the print at most, mm (default 250,210,210)");
}

}  // namespace

void add_slice_command(CLI::App& app, CommonOptions&, Action& action) {
  auto command = std::make_shared<SliceCommand>();
  CLI::App* sub = app.add_subcommand("slice", "Turn a closed surface into G-code by a slicer");
  sub->add_option("surface", command->surface,
                  "Closed surface, mm: .stl .ply .obj .vtp .3mf .amf .vtk")
      ->required();
  sub->add_option("--slicer", command->slicer, "prusa (PrusaSlicer) or cura (CuraEngine)")
      ->check(CLI::IsMember({"prusa", "cura"}))
      ->required();
  sub->add_option("-o,--output", command->output, "G-code: .gcode");
  sub->add_option("--report", command->report, "Report: .json");
  add_print_options(*sub, command);
  sub->callback([command, &action] { action = [command] { return run_slice(*command); }; });
}

}  // namespace mesamis
