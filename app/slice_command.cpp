// SPDX-License-Identifier: Apache-2.0
// mesamis slice: G-code of a closed surface by a slicer, and what the print takes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "arguments.h"
#include "commands.h"
#include "interrupt.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/files/sha256.h"
#include "mesamis/printing/slice_surface.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/report.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/volume_files/read_volume.h"
#include "outputs.h"
#include "process.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct SliceCommand {
  fs::path surface, output, report;
  std::string slicer;  ///< "prusa" or "cura"
  SliceSettings settings;

  Slicer program() const { return slicer == "cura" ? Slicer::kCuraEngine : Slicer::kPrusaSlicer; }
};

ordered_json prusa_json(const PrusaInfo& info) {
  ordered_json repairs = ordered_json::object();
  for (const auto& [what, count] : info.repairs) repairs[what] = count;
  return {{"manifold", info.manifold},
          {"open_edges", info.open_edges},
          {"parts", info.parts},
          {"volume_mm3", info.volume},
          {"repairs", repairs}};
}

/// The entry "gate" of the report.
ordered_json gate_json(const PrintCheck& check) {
  ordered_json by = ordered_json::array({"mesamis"});
  if (check.prusa) by.push_back("prusa-slicer --info");
  return {{"passed", print_flaws_of(check).empty()},
          {"by", by},
          {"closed", check.surface.closed()},
          {"manifold", check.surface.manifold()},
          {"open_edges", check.surface.open_edges},
          {"nonmanifold_edges", check.surface.nonmanifold_edges},
          {"misoriented_edges", check.surface.misoriented_edges},
          {"nonmanifold_points", check.surface.nonmanifold_points},
          {"degenerate_triangles", check.surface.degenerate_triangles},
          {"parts", check.surface.components},
          {"volume_mm3", check.surface.volume},
          {"self_intersections", check.self_intersections},
          {"prusa_slicer", check.prusa ? prusa_json(*check.prusa) : ordered_json()}};
}

ordered_json settings_json(const SliceSettings& settings) {
  const PrintBed& bed = settings.bed;
  return {{"layer_mm", settings.layer},
          {"infill_percent", settings.infill},
          {"perimeters", settings.perimeters},
          {"support", settings.support},
          {"bed_mm", {bed.width, bed.depth, bed.height}},
          {"shell_mm", kShell},
          {"nozzle_mm", kNozzle},
          {"filament_diameter_mm", kFilamentDiameter},
          {"filament_density_g_cm3", kFilamentDensity}};
}

/// The report as far as the gate.
ordered_json base_report(const SliceCommand& command, const SliceResult& result) {
  ordered_json report;
  report["program"] = program_json();
  report["input"] = {{"path", command.surface.string()},
                     {"sha256", sha256(command.surface)},
                     {"triangles", result.triangles},
                     {"size_mm", vec_json(result.size)}};
  report["settings"] = settings_json(command.settings);
  report["gate"] = gate_json(result.check);
  return report;
}

ordered_json known(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

void write_report(const SliceCommand& command, const SliceResult& result) {
  const GcodeFacts& facts = result.gcode;
  ordered_json report = base_report(command, result);
  report["slicer"] = {{"name", slicer_name(command.program())},
                      {"version", facts.version},
                      {"path", result.run.program.string()},
                      {"arguments", result.run.arguments}};
  report["layers"] = facts.layers;
  report["gcode_lines"] = facts.lines;
  report["gcode_bytes"] = facts.bytes;
  report["estimated_print_seconds"] = known(facts.print_seconds);
  report["filament_mm"] = known(facts.filament_mm);
  report["filament_cm3"] = known(facts.filament_cm3);
  report["filament_g"] = known(facts.filament_g);
  report["seconds"] = result.run.seconds;
  report["cpu_seconds"] = result.run.cpu_seconds;
  report["peak_memory_mb"] = result.run.peak_memory_mb;
  report["seconds_total"] = wall_seconds();
  write_json(command.report, report);
}

std::string duration_text(double seconds) {
  const auto minutes = std::llround(seconds / 60);
  if (minutes == 0) return std::to_string(std::llround(seconds)) + " s";
  const std::string rest = std::to_string(minutes % 60) + " min";
  return minutes < 60 ? rest : std::to_string(minutes / 60) + " h " + rest;
}

void print_result(const SliceCommand& command, const SliceResult& result) {
  const GcodeFacts& facts = result.gcode;
  std::cout << slicer_name(command.program()) << " " << facts.version << ": " << facts.layers
            << " layers, " << facts.lines << " lines (" << 1e-6 * static_cast<double>(facts.bytes)
            << " MB) of G-code";
  if (facts.print_seconds) std::cout << "; print " << duration_text(*facts.print_seconds);
  if (facts.filament_mm && facts.filament_g) {
    std::cout << ", filament " << *facts.filament_mm / 1000 << " m, " << *facts.filament_g << " g";
  }
  std::cout << "; sliced in " << result.run.seconds << " s, " << result.run.peak_memory_mb
            << " MB\n";
}

/// Checks everything that can be checked before the surface is read.
void require_all(const SliceCommand& command) {
  if (!command.output.empty()) require_output(command.output, {".gcode"}, "--output");
  if (!command.report.empty()) require_output(command.report, {".json"}, "--report");
  require_distinct_files({command.output, command.report}, {command.surface});
  require_slicer(command.program());
}

/// Slices; an interrupt ends the slicer and removes its files.
SliceResult slice(const SliceCommand& command, const ReadLimits& limits) {
  std::optional<HeldInterrupts> held;  // from the first temporary file on
  SliceOptions options{command.program(), command.settings, command.output};
  options.progress = [&held, &command](std::string_view stage, double) {
    if (stage == "slice" && !held) {
      held.emplace();
      log_info(std::string("slicing with ") + slicer_name(command.program()));
    }
    return noted_interrupt() == 0;
  };
  try {
    return slice_surface(read_surface(command.surface, limits), options);
  } catch (const Cancelled&) {
    throw Interrupted();
  }
}

/// A surface that cannot be printed: says why and reports the gate alone.
int refuse_unprintable(const SliceCommand& command, const SliceResult& result) {
  if (!command.report.empty()) write_json(command.report, base_report(command, result));
  log_error(command.surface.string() + ": expected a closed 2-manifold that faces outward, found " +
            print_flaws_of(result.check));
  return kExitNotClosed;
}

[[noreturn]] void refuse_too_large(const SliceCommand& command, const SliceResult& result) {
  const PrintBed& bed = command.settings.bed;
  throw InputError(command.surface.string() + ": expected a surface that fits on a bed of " +
                   size_text({bed.width, bed.depth, bed.height}) +
                   " (width x depth x height), found " + size_text(result.size) +
                   "; --bed X,Y,Z gives another bed");
}

int run_slice(const SliceCommand& command, const ReadLimits& limits) {
  require_all(command);
  const SliceResult result = slice(command, limits);
  if (result.outcome == SliceOutcome::kNotPrintable) return refuse_unprintable(command, result);
  if (result.outcome == SliceOutcome::kDoesNotFit) refuse_too_large(command, result);
  for (const std::string& warning : result.warnings) log_warning(warning);
  if (!command.report.empty()) write_report(command, result);
  print_result(command, result);
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

/// "width,depth" or "width,depth,height" in mm.
PrintBed bed_of(const std::string& text) {
  const bool has_height = std::count(text.begin(), text.end(), ',') == 2;
  const std::vector<double> numbers = parse_numbers(text, has_height ? 3 : 2, "--bed");
  const PrintBed bed{numbers[0], numbers[1], has_height ? numbers[2] : PrintBed().height};
  try {
    require_valid(bed);
  } catch (const InputError&) {
    throw CLI::ValidationError("--bed",
                               "expected lengths from 1 to 10000 mm, found '" + text + "'");
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
           help)
        ->type_name(option.whole ? "N" : "X");
  };
  add({"--layer", kLayerMin, kNozzle, " mm (the nozzle)"}, "Height of a layer, mm (default 0.3)",
      [](SliceSettings& s, double value) { s.layer = value; });
  add({"--infill", 0, 100, "%"}, "Density of the infill, percent (default 5)",
      [](SliceSettings& s, double value) { s.infill = value; });
  add({"--perimeters", 0, kPerimetersMax, "", true}, "Lines around each layer (default 2)",
      [](SliceSettings& s, double value) { s.perimeters = static_cast<int>(value); });
  sub.add_flag("--support", settings.support, "Support what hangs over");
  sub.add_option_function<std::string>(
         "--bed", [command](const std::string& text) { command->settings.bed = bed_of(text); },
         "Width, depth[, height] of the print at most, mm (default 250,210,210)")
      ->type_name("X,Y[,Z]");
}

}  // namespace

void add_slice_command(CLI::App& app, CommonOptions& common, Action& action) {
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
  sub->callback([command, &common, &action] {
    action = [command, &common] { return run_slice(*command, common.limits); };
  });
}

}  // namespace mesamis
