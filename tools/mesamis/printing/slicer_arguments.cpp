// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/slicer_arguments.h"

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

namespace mesamis::detail::printing {
namespace {

constexpr double kGridUpTo = 25;  // percent; above, lines that alternate from layer to layer
constexpr int kNozzleCelsius = 210;
constexpr int kBedCelsius = 60;
constexpr double kOverhangDegrees = 50;  // from the vertical

/// The shortest decimal text that reads back as the same number.
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
  const std::string x = text_of(settings.bed.width), y = text_of(settings.bed.depth);
  std::ostringstream corners;
  corners << "0x0," << x << "x0," << x << "x" << y << ",0x" << y;
  return corners.str();
}

std::vector<std::string> prusa_arguments(const SliceSettings& settings) {
  const std::string layer = text_of(settings.layer), solid = std::to_string(shell_layers(settings));
  std::vector<std::string> arguments{
      // An empty configuration folder, so that only these options count.
      "--datadir", "prusa", "--loglevel", "1", "--export-gcode",
      // The surface has the coordinates of the print.
      "--dont-arrange", "--bed-shape", bed_outline(settings), "--max-print-height",
      text_of(settings.bed.height), "--layer-height", layer, "--first-layer-height", layer,
      "--fill-density", text_of(settings.infill) + "%", "--fill-pattern",
      settings.infill > kGridUpTo ? "rectilinear" : "grid", "--perimeters",
      std::to_string(settings.perimeters),
      // The other generator, Arachne, gives different lines in each run.
      "--perimeter-generator", "classic",
      // Exactly the number of perimeters; slopes are closed by solid infill instead.
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

/// The distance of infill lines by Cura's formula, mm; 0: no infill. A grid has lines in two
/// directions.
double infill_distance(const SliceSettings& settings) {
  if (settings.infill == 0) return 0;
  return kNozzle * 100 / settings.infill * (settings.infill > kGridUpTo ? 1 : 2);
}

using CuraSettings = std::vector<std::pair<std::string, std::string>>;

/// The settings, and those that Cura's user interface derives from them: CuraEngine itself derives
/// none.
CuraSettings cura_settings(const SliceSettings& settings) {
  const std::string layer = text_of(settings.layer), solid = std::to_string(shell_layers(settings));
  const std::string walls = text_of(kNozzle * settings.perimeters);
  CuraSettings list{{"machine_width", text_of(settings.bed.width)},
                    {"machine_depth", text_of(settings.bed.depth)},
                    {"machine_height", text_of(settings.bed.height)},
                    // CuraEngine adds half the bed to all coordinates.
                    {"mesh_position_x", text_of(-settings.bed.width / 2)},
                    {"mesh_position_y", text_of(-settings.bed.depth / 2)},
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

std::vector<std::string> cura_arguments(const InstalledSlicer& slicer,
                                        const SliceSettings& settings) {
  // -v: without it, the final header is not logged.
  std::vector<std::string> arguments{"slice", "-v", "-j", slicer.definition.string()};
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

}  // namespace

std::vector<std::string> slicer_arguments(const InstalledSlicer& slicer,
                                          const SliceSettings& settings) {
  if (slicer.slicer == Slicer::kPrusaSlicer) return prusa_arguments(settings);
  return cura_arguments(slicer, settings);
}

}  // namespace mesamis::detail::printing
