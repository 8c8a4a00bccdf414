// SPDX-License-Identifier: Apache-2.0
#include "slicers.h"

#include <stdlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "arguments.h"
#include "mesamis/base/error.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

constexpr double kGridUpTo = 25;  // percent; above, lines that alternate from layer to layer
constexpr std::size_t kLongestLine = 200;
constexpr int kNozzleCelsius = 210;
constexpr int kBedCelsius = 60;
constexpr double kOverhangDegrees = 50;  // from the vertical

/// The shortest decimals that are this number.
std::string text_of(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

/// Solid layers that are as thick as the shell.
int shell_layers(const SliceSettings& settings) {
  return static_cast<int>(std::ceil(kShell / settings.layer - 1e-9));
}

/// The corners of the bed: "0x0,250x0,250x210,0x210".
std::string bed_outline(const SliceSettings& settings) {
  const std::string x = text_of(settings.bed[0]), y = text_of(settings.bed[1]);
  std::ostringstream corners;
  corners << "0x0," << x << "x0," << x << "x" << y << ",0x" << y;
  return corners.str();
}

std::vector<std::string> prusa_arguments(const SliceSettings& settings) {
  const std::string layer = text_of(settings.layer), solid = std::to_string(shell_layers(settings));
  std::vector<std::string> arguments{
      // An empty folder for its configuration: only what stands here counts.
      "--datadir", "prusa", "--loglevel", "1", "--export-gcode",
      // The surface is where it shall be printed.
      "--dont-arrange", "--bed-shape", bed_outline(settings), "--max-print-height",
      text_of(settings.bed[2]), "--layer-height", layer, "--first-layer-height", layer,
      "--fill-density", text_of(settings.infill) + "%", "--fill-pattern",
      settings.infill > kGridUpTo ? "rectilinear" : "grid", "--perimeters",
      std::to_string(settings.perimeters),
      // The other generator, Arachne, gives other lines each time.
      "--perimeter-generator", "classic",
      // No more perimeters than asked for; slopes are closed by solid infill instead.
      "--no-extra-perimeters", "--ensure-vertical-shell-thickness", "--top-solid-layers", solid,
      "--bottom-solid-layers", solid, "--skirts", "0", "--gcode-flavor", "marlin",
      "--nozzle-diameter", text_of(kNozzle), "--filament-diameter", text_of(kFilamentDiameter),
      "--filament-density", text_of(kFilamentDensity), "--temperature",
      std::to_string(kNozzleCelsius), "--first-layer-temperature", std::to_string(kNozzleCelsius),
      "--bed-temperature", std::to_string(kBedCelsius), "--first-layer-bed-temperature",
      std::to_string(kBedCelsius)};
  if (settings.support) {
    arguments.insert(arguments.end(), {"--support-material", "--support-material-threshold",
                                       text_of(90 - kOverhangDegrees)});
  }
  arguments.insert(arguments.end(), {"--output", kGcodeFile, kSurfaceFile});
  return arguments;
}

/// The distance of infill lines, mm; 0: none. Cura's own formula: a grid has lines in two
/// directions.
double infill_distance(const SliceSettings& settings) {
  if (settings.infill == 0) return 0;
  return kNozzle * 100 / settings.infill * (settings.infill > kGridUpTo ? 1 : 2);
}

using CuraSettings = std::vector<std::pair<std::string, std::string>>;

/// Cura's window computes settings from each other; CuraEngine takes each as it is given. What
/// follows from ours by Cura's formulas is therefore set here.
CuraSettings cura_settings(const SliceSettings& settings) {
  const std::string layer = text_of(settings.layer), solid = std::to_string(shell_layers(settings));
  const std::string walls = text_of(kNozzle * settings.perimeters);
  CuraSettings list{{"machine_width", text_of(settings.bed[0])},
                    {"machine_depth", text_of(settings.bed[1])},
                    {"machine_height", text_of(settings.bed[2])},
                    // CuraEngine adds half the bed to all coordinates.
                    {"mesh_position_x", text_of(-settings.bed[0] / 2)},
                    {"mesh_position_y", text_of(-settings.bed[1] / 2)},
                    {"machine_heated_bed", "true"},
                    {"machine_nozzle_size", text_of(kNozzle)},
                    {"adhesion_type", "none"},
                    {"layer_height", layer},
                    {"layer_height_0", layer},
                    {"infill_sparse_thickness", layer},
                    {"support_infill_sparse_thickness", layer},
                    {"wall_line_count", std::to_string(settings.perimeters)},
                    {"infill_sparse_density", text_of(settings.infill)},
                    {"infill_pattern", settings.infill > kGridUpTo ? "lines" : "grid"},
                    {"infill_line_distance", text_of(infill_distance(settings))},
                    {"top_layers", solid},
                    {"bottom_layers", solid},
                    {"initial_bottom_layers", solid},
                    {"skin_edge_support_layers", "0"},
                    {"material_print_temperature", std::to_string(kNozzleCelsius)},
                    {"material_print_temperature_layer_0", std::to_string(kNozzleCelsius)},
                    {"material_bed_temperature", std::to_string(kBedCelsius)},
                    {"material_bed_temperature_layer_0", std::to_string(kBedCelsius)},
                    {"support_enable", settings.support ? "true" : "false"},
                    {"support_angle", text_of(kOverhangDegrees)},
                    {"support_wall_count", "0"}};
  for (const auto* shrink : {"skin_preshrink", "top_skin_preshrink", "bottom_skin_preshrink",
                             "expand_skins_expand_distance", "top_skin_expand_distance",
                             "bottom_skin_expand_distance"}) {
    list.emplace_back(shrink, walls);
  }
  return list;
}

std::vector<std::string> cura_arguments(const SliceSettings& settings) {
  // -v: without it, the final header is not logged.
  std::vector<std::string> arguments{"slice", "-v", "-j", cura_definition().string()};
  for (const auto& [key, value] : cura_settings(settings)) {
    std::string setting = key;
    setting.append("=").append(value);
    arguments.insert(arguments.end(), {"-s", setting});
  }
  // The first extruder has a filament of its own.
  arguments.insert(arguments.end(), {"-e0", "-s", "material_diameter=" + text_of(kFilamentDiameter),
                                     "-o", kGcodeFile, "-l", kSurfaceFile});
  return arguments;
}

constexpr std::array kSlicers{
    Slicer{"prusa", "PrusaSlicer", "prusa-slicer", "prusa-slicer", prusa_arguments},
    Slicer{"cura", "CuraEngine", "CuraEngine", "cura-engine", cura_arguments}};

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

bool says_error(std::string_view line) {
  return contains(line, "error") || contains(line, "ERROR") || contains(line, "what():");
}

/// Progress, traces and the settings that CuraEngine repeats.
bool is_noise(std::string_view line) {
  return line.empty() || contains(line, "=> ") || contains(line, "[trace]") ||
         contains(line, "[WARNING]") || contains(line, "Progress:") || contains(line, " -s ");
}

/// "key = value", white space around both left out.
bool split_entry(std::string_view line, std::string& key, std::string& value) {
  const std::size_t sign = line.find(" = ");
  if (sign == std::string_view::npos) return false;
  key = line.substr(0, sign);
  value = line.substr(sign + 3);
  value.erase(0, value.find_first_not_of(' '));
  return true;
}

/// What --info says of every surface, sound or not, and is no repair.
bool is_description(std::string_view key) {
  constexpr std::array kPrefixes{"size_", "min_", "max_", "number_of_facets"};
  return std::any_of(kPrefixes.begin(), kPrefixes.end(), [key](std::string_view prefix) {
    return key.substr(0, prefix.size()) == prefix;
  });
}

void take_entry(const std::string& key, const std::string& value, PrusaInfo& info) {
  if (key == "manifold") {
    info.manifold = value == "yes";
    return;
  }
  double number = 0;
  if (is_description(key) || !parse_number(value, number)) return;
  const auto whole = static_cast<std::int64_t>(std::clamp(number, -1e18, 1e18));
  if (key == "volume") {
    info.volume = number;
  } else if (key == "open_edges") {
    info.open_edges = whole;
  } else if (key == "number_of_parts") {
    info.parts = whole;
  } else if (whole != 0) {
    info.repairs.emplace_back(key, whole);
  }
}

}  // namespace

const Slicer& slicer_called(std::string_view key) {
  return *std::find_if(kSlicers.begin(), kSlicers.end() - 1,
                       [key](const Slicer& slicer) { return slicer.key == key; });
}

fs::path require_program(const Slicer& slicer) {
  fs::path program = find_program(slicer.program);
  if (!program.empty()) return program;
  throw InputError(std::string(slicer.program) + ": expected this program in PATH, found none; " +
                   "on Debian: apt install " + slicer.package);
}

fs::path cura_definition() {
  const char* given = getenv("CURA_ENGINE_SEARCH_PATH");
  std::istringstream folders(std::string(given ? given : "") +
                             ":/usr/share/cura/resources/definitions");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / "fdmprinter.def.json";
    std::error_code ignored;
    if (!folder.empty() && fs::exists(file, ignored)) return fs::absolute(file);
  }
  throw InputError(
      "fdmprinter.def.json: expected CuraEngine's definitions in "
      "/usr/share/cura/resources/definitions or CURA_ENGINE_SEARCH_PATH, found none; on Debian: "
      "apt install cura");
}

std::string failure_line(std::string_view output) {
  std::istringstream lines{std::string(output)};
  std::string before, last;
  for (std::string line; std::getline(lines, line);) {
    line = one_line(line);
    line.erase(0, line.find_first_not_of(' '));
    if (says_error(line)) return line.substr(0, kLongestLine);
    if (is_noise(line)) continue;
    before = std::exchange(last, line);
  }
  if (!before.empty()) before += ' ';
  return (before + last).substr(0, kLongestLine);
}

PrusaInfo parse_prusa_info(std::string_view output) {
  PrusaInfo info;
  std::istringstream lines{std::string(output)};
  std::string key, value;
  for (std::string line; std::getline(lines, line);) {
    if (split_entry(one_line(line), key, value)) take_entry(key, value, info);
  }
  return info;
}

}  // namespace mesamis
