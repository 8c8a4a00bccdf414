// SPDX-License-Identifier: Apache-2.0
// mesamis slicer-segment: `segment` as 3D Slicer calls it, a module of its execution model.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "arguments.h"
#include "commands.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/files/atomic_file.h"
#include "outputs.h"
#include "segment_run.h"
#include "slicer_description.h"
#include "slicer_progress.h"

namespace mesamis {
namespace {

using Json = nlohmann::ordered_json;

struct SlicerArguments {
  SegmentOptions segment;
  bool xml = false;
  std::filesystem::path model, mesh, results;  ///< may be empty, the model but for --xml
  std::string tissue = kAnyBright;
  std::string modality = kStatedModality;
  std::string values, labels, region;  ///< as Slicer writes them; may be empty
  std::string margin, time_limit;      ///< numbers; may be empty
};

/// A number in a field of text, which may be empty.
std::optional<double> optional_number(const std::string& text, const std::string& option) {
  if (text.empty()) return std::nullopt;
  double value = 0;
  if (!parse_number(text, value) || !(value > 0)) {
    throw CLI::ValidationError(option, "expected a number above 0, found " + quoted_text(text));
  }
  return value;
}

/// Slicer's region as a box of the world: its centre, its half sizes and, of a rotated one, the
/// nine numbers of a matrix whose columns are its axes. A rotated one gives the box around it.
std::string box_of_region(const std::string& text) {
  const std::string option = "--region";
  const auto count = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  const std::vector<double> n = parse_numbers(text, count > 5 ? 15 : 6, option);
  std::string box;
  for (std::size_t row = 0; row < 3; ++row) {
    double half = n[3 + row];
    if (n.size() == 15) {
      half = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        half += std::abs(n[6 + 3 * row + axis] * n[3 + axis]);
      }
    }
    box += (row > 0 ? "," : "") + number_text(n[row] - half) + ":" + number_text(n[row] + half);
  }
  return box;
}

/// "3,femur" as two labels.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// Slicer gives every number and choice, whether it was touched or not: what is as the table has it
/// says nothing, so that a preset and a file of settings count.
void drop_untouched(SettingsArguments& arguments) {
  const auto is_default = [](const SettingsArguments::Override& given) {
    const Setting& setting = find_setting(given.name);
    return parsed(given.option, [&] { return parse_value(setting, given.text); }) ==
           setting.get({});
  };
  auto& overrides = arguments.overrides;
  overrides.erase(std::remove_if(overrides.begin(), overrides.end(), is_default), overrides.end());
}

std::string tissue_of(const SlicerArguments& a) {
  const bool any = a.tissue == kAnyBright;
  if (!a.values.empty() && !any) {
    throw CLI::ValidationError("--values", "expected --tissue " + std::string(kAnyBright) +
                                               " beside it, found " + a.tissue);
  }
  return any ? a.values : a.tissue;
}

/// What Slicer asked for, as `segment` takes it.
SegmentOptions segment_options(SlicerArguments a) {
  SegmentOptions& s = a.segment;
  s.out.surfaces = {a.model};
  if (!a.mesh.empty()) s.out.meshes = {a.mesh};
  s.scan.places.tissue = tissue_of(a);
  if (a.modality != kStatedModality) s.scan.read.modality = a.modality;
  s.scan.labels.chosen = parts_of(a.labels);
  s.scan.labels.margin = optional_number(a.margin, "--margin");
  s.time_limit = optional_number(a.time_limit, "--time_limit");
  if (!a.region.empty()) s.scan.places.box = box_of_region(a.region);
  drop_untouched(s.settings);
  const bool several = s.scan.labels.given() || s.scan.places.seeds.size() > 1;
  if (s.out.error && several) {
    log_warning("--error: several objects in one model carry no expected error");
    s.out.error = false;
  }
  return s;
}

// ---- What is given back.

/// A figure of an entry, or null.
Json figure(const Json& entry, std::initializer_list<const char*> keys) {
  const Json* at = &entry;
  for (const char* key : keys) {
    if (!at->is_object() || !at->contains(key)) return nullptr;
    at = &at->at(key);
  }
  return *at;
}

/// The surfaces of a report, whether of one object or of several.
std::vector<Json> surfaces_of(const Json& report) {
  const Json several = figure(report, {"object", "surfaces"});
  if (several.is_array()) return {several.begin(), several.end()};
  return {report.at("surface")};
}

/// The sum of a figure, or null where one is missing.
Json sum_of(const std::vector<Json>& surfaces, const char* key, double unit) {
  double sum = 0;
  for (const Json& surface : surfaces) {
    const Json value = figure(surface, {key});
    if (!value.is_number()) return nullptr;
    sum += value.get<double>();
  }
  return sum / unit;
}

Json results_of(const Json& report) {
  const std::vector<Json> surfaces = surfaces_of(report);
  const bool converged = figure(report, {"converged"}) != false;
  return {{"result_objects", surfaces.size()},
          {"result_triangles", sum_of(surfaces, "triangles", 1)},
          {"result_volume_cm3", sum_of(surfaces, "volume_mm3", 1e3)},
          {"result_area_cm2", sum_of(surfaces, "area_mm2", 1e2)},
          {"result_level", figure(report, {"surface", "level_native"})},
          {"result_error_mm", figure(report, {"quality", "expected_error_mm", "mean"})},
          {"result_outcome", converged ? "converged" : "not converged"}};
}

std::string value_text(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  const double number = value.get<double>();
  constexpr double kMostDigits = 1e15;
  const bool whole = number == std::floor(number) && std::abs(number) < kMostDigits;
  return whole ? std::to_string(static_cast<std::int64_t>(number)) : number_text(number);
}

/// "name = value" lines, a value empty where there is none.
std::string result_lines(const Json& results) {
  std::string lines;
  for (const char* name : kSlicerResults) {
    lines += std::string(name) + " = " + value_text(results.at(name)) + "\n";
  }
  return lines;
}

/// Slicer loads nothing of a module that ends with another status than 0: a run that has not
/// converged is one with a warning.
int run_for_slicer(const SlicerArguments& arguments, const CommonOptions& common) {
  if (arguments.model.empty()) {
    throw CLI::ValidationError("model", "expected a scan and a model, found less");
  }
  require_output(arguments.model, {".vtp", ".stl", ".ply", ".obj"}, "model");
  SegmentOptions options = segment_options(arguments);
  if (!arguments.results.empty()) {
    require_writable(arguments.results);
    options.report_reader_file = arguments.results;
    options.out.facts.written = [&](const Json& report, OutputSet& set) {
      write_file(set.file(arguments.results), result_lines(results_of(report)));
    };
  }
  const int status = run_segment(std::move(options), common);
  if (status == kExitDone || status == kExitNotConverged) tell_slicer_done();
  return status == kExitNotConverged ? kExitDone : status;
}

int print_description() {
  std::cout << slicer_description();
  return kExitDone;
}

void add_object_options(CLI::App& c, SlicerArguments& a) {
  ScanArguments& scan = a.segment.scan;
  c.add_option("--tissue", a.tissue, "Tissue, as of segment; bright: all that is bright")
      ->type_name("NAME");
  c.add_option("--modality", a.modality,
               "Modality of the scan, which Slicer's temporary files do not state")
      ->check(CLI::IsMember(modality_words()));
  c.add_option("--values", a.values, "LO:HI, native units, instead of a tissue")
      ->type_name("LO:HI");
  c.add_option("--labels", scan.labels.file, "Label map whose labels choose the objects");
  c.add_option("--label", a.labels, "Numbers or names of labels, commas between")
      ->type_name("NAMES");
  c.add_option("--mask", scan.places.mask, "Label map: only what lies near a marked voxel");
  c.add_option("--margin", a.margin, "How far labels may be wrong, or around the mask, mm")
      ->type_name("MM");
  c.add_option("--seed", scan.places.seeds, "X,Y,Z, mm, LPS: the island with this point; several")
      ->type_name("X,Y,Z")
      ->allow_extra_args(false);
  c.add_option("--region", a.region,
               "X,Y,Z,RX,RY,RZ, mm, LPS: centre and half sizes of a part; "
               "nine numbers more turn it")
      ->type_name("NUMBERS");
  c.add_flag("--keep_surroundings", scan.places.keep_surroundings, "Leave table and head rest");
}

void add_file_options(CLI::App& c, SlicerArguments& a) {
  c.add_flag("--xml", a.xml, "Print the description of the module, and nothing else");
  c.add_option("scan", a.segment.scan.input, "Volume, as Slicer writes it: .nrrd");
  c.add_option("model", a.model, "Surface, as Slicer reads it: .vtp .stl .ply .obj");
  c.add_option("--labelmap", a.segment.out.labelmap,
               "What was found on the scan's grid: .nrrd .nii");
  c.add_option("--mesh", a.mesh, "Adapted mesh: .vtu");
  c.add_option("--report", a.segment.out.report, "Report: .json");
  c.add_option("--returnparameterfile", a.results, "Figures of the run, name = value");
  c.add_flag("--error", a.segment.out.error, "Write the error expected at each point, mm");
  c.add_option("--time_limit", a.time_limit, "Seconds after which no further mesh is begun")
      ->type_name("S");
}

}  // namespace

void add_slicer_segment_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<SlicerArguments>();
  CLI::App* command = app.add_subcommand(
      "slicer-segment", "What 3D Slicer runs: a module of its execution model (docs/slicer.md)");
  add_file_options(*command, *arguments);
  add_object_options(*command, *arguments);
  add_settings_options(*command, arguments->segment.settings, '_');
  command->callback([arguments, &common, &action] {
    common.for_slicer = true;
    action = [arguments, &common] {
      return arguments->xml ? print_description() : run_for_slicer(*arguments, common);
    };
  });
}

}  // namespace mesamis
