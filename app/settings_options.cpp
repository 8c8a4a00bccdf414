// SPDX-License-Identifier: Apache-2.0
#include "settings_options.h"

#include <algorithm>
#include <functional>
#include <sstream>
#include <vector>

#include "arguments.h"
#include "json_file.h"
#include "mesamis/base/error.h"
#include "settings_json.h"

namespace mesamis {
namespace {

using nlohmann::json;

/// A number, or one of the words allowed.
json number_or_word(const std::string& text, const std::vector<std::string>& words,
                    const std::string& option) {
  for (const std::string& word : words) {
    if (text == word) return word;
  }
  double value = 0;
  if (parse_number(text, value)) return value;
  throw CLI::ValidationError(option, "'" + text + "' is neither a number nor a word it knows");
}

/// Adds an option whose text becomes one entry of the overrides.
using Parse = std::function<json(const std::string&)>;
void add_setting(CLI::App& command, SettingsArguments& arguments, const std::string& flag,
                 const std::string& help, const Parse& parse) {
  std::string key = flag.substr(2);
  std::replace(key.begin(), key.end(), '-', '_');
  command
      .add_option_function<std::string>(
          flag,
          [key, parse, &arguments](const std::string& text) {
            arguments.overrides[key] = parse(text);
          },
          help)
      ->group("Settings");
}

void add_number(CLI::App& command, SettingsArguments& arguments, const std::string& flag,
                const std::string& help, const std::vector<std::string>& words = {}) {
  add_setting(command, arguments, flag, help,
              [=](const std::string& text) { return number_or_word(text, words, flag); });
}

void add_word(CLI::App& command, SettingsArguments& arguments, const std::string& flag,
              const std::string& help) {
  add_setting(command, arguments, flag, help, [](const std::string& text) { return json(text); });
}

/// "1", "1,1,2", "none" or "auto" as the setting has it: three numbers or a word.
json blur_of_axes(const std::string& text) {
  if (text == "auto") return json(text);
  if (text == "none") return json({0, 0, 0});
  double value = 0;
  if (parse_number(text, value)) return json({value, value, value});
  return json(parse_numbers(text, 3, "--blur"));
}

void add_image_settings(CLI::App& c, SettingsArguments& a) {
  add_setting(c, a, "--crop", "Voxels to use, I0:I1,J0:J1,K0:K1 (ends excluded, may be empty)",
              [](const std::string& text) { return crop_ranges(text, "--crop"); });
  add_setting(c, a, "--stride", "Voxels per node of the first grid, X,Y,Z (default 1,1,1)",
              [](const std::string& text) { return json(parse_integers(text, 3, "--stride")); });
  add_setting(c, a, "--window", "Native values mapped to 0 and 255, LO,HI or auto (default auto)",
              [](const std::string& text) {
                return text == "auto" ? json(text) : json(parse_numbers(text, 2, "--window"));
              });
  add_number(c, a, "--noise", "Standard deviation of the noise, native units, or auto (default)",
             {"auto"});
  add_setting(c, a, "--blur",
              "Blur to undo, standard deviation in voxels: S, X,Y,Z, none or auto (default)",
              blur_of_axes);
  add_number(c, a, "--threshold", "Native value below which all is one tissue, auto or none",
             {"auto", "none"});
  add_number(c, a, "--level", "Native value of the solid surface, or auto", {"auto"});
}

void add_method_settings(CLI::App& c, SettingsArguments& a) {
  add_word(c, a, "--length-unit", "Unit of the parameters' lengths: voxel or mm (default voxel)");
  add_number(c, a, "--epsilon", "Thickness of the edge indicator (default 1e-3)");
  add_number(c, a, "--eta", "Smallest diffusion at edges (default epsilon squared)", {"auto"});
  add_number(c, a, "--beta", "Weight of smoothness away from edges (default 2)");
  add_number(c, a, "--gamma",
             "Price of edges, or auto (default): by the contrast and the noise; the paper: 0.1",
             {"auto"});
  add_number(c, a, "--amis-iterations", "Alternations per mesh at most (default 10)");
  add_number(c, a, "--tol-v", "Alternations stop at this change of v (default 1e-2)");
  add_number(c, a, "--solver-tolerance", "Relative residual of each solve (default 1e-6)");
  add_number(c, a, "--max-tets", "Cells of the mesh at most, or auto", {"auto"});
  add_number(c, a, "--tau", "Tolerance on the error estimator (default 1e-2)");
  add_number(c, a, "--adaptations", "Adaptations at most (default 10)");
  add_number(c, a, "--tol-mesh", "Settled: relative change of the cell count (default 1e-2)");
  add_number(c, a, "--tol-energy", "Settled: relative change of the energy (default 1e-2)");
  add_number(c, a, "--max-stretch", "Longest to shortest size of a cell (default 10)");
  add_number(c, a, "--gradation",
             "Growth of sizes from edge to edge at most, above 1 (default 0: any)");
  add_number(c, a, "--h-min", "Smallest edge, in length units (default 0.5)");
  add_number(c, a, "--h-max", "Largest edge, in length units, or auto", {"auto"});
  add_word(c, a, "--surface", "solid: closed level set of u (default); band: the paper's surface");
  add_number(c, a, "--band-threshold", "The band's cells have v below this (default 0.1)");
  add_number(
      c, a, "--min-volume",
      "Drop islands and fill cavities of the solid below so many mm^3 (default auto: 4 voxels)",
      {"auto"});
  add_number(c, a, "--keep-largest", "Islands of the solid to keep (default 0: all)");
  c.add_flag_callback(
       "--fill-cavities", [&a] { a.overrides["fill_cavities"] = true; },
       "Fill the cavities of the solid")
      ->group("Settings");
  add_number(c, a, "--tolerance",
             "Decimate the solid surface within this distance, mm (default auto: 0.1 voxel; 0: no)",
             {"auto"});
  add_number(c, a, "--triangles", "Decimate the solid surface to this many", {"auto"});
  c.add_flag_callback(
       "--stop-at-first", [&a] { a.overrides["stop_at_first"] = true; },
       "Stop when mesh or energy has settled, as printed in the paper (default: both)")
      ->group("Settings");
}

}  // namespace

void add_settings_options(CLI::App& command, SettingsArguments& arguments) {
  command.add_option("--settings", arguments.file, "Settings or a report: .json");
  add_image_settings(command, arguments);
  add_method_settings(command, arguments);
}

Settings settings_of(const SettingsArguments& arguments) {
  Settings settings;
  if (!arguments.file.empty()) {
    json file = read_json(arguments.file);
    // A whole report serves as well: its settings are those of the run.
    if (file.is_object() && file.contains("settings")) file = file["settings"];
    try {
      from_json(file, settings);
      require_valid(settings);
    } catch (const InputError& error) {
      throw InputError(arguments.file.string() + ": " + error.what());
    }
  }
  as_usage([&] {
    from_json(arguments.overrides, settings);
    require_valid(settings);
  });
  return settings;
}

void add_frame_option(CLI::App& command, Frame& frame) {
  command
      .add_option_function<std::string>(
          "--frame",
          [&frame](const std::string& name) { frame = name == "ras" ? Frame::kRas : Frame::kLps; },
          "Frame of the files written (default lps)")
      ->check(CLI::IsMember({"lps", "ras"}));
}

json crop_ranges(const std::string& text, const std::string& option) {
  json ranges = json::array();
  std::stringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    const auto colon = part.find(':');
    if (colon == std::string::npos) {
      throw CLI::ValidationError(option, "expected I0:I1,J0:J1,K0:K1, found " + text);
    }
    auto bound = [&option](const std::string& number, int otherwise) {
      return number.empty() ? otherwise : parse_integers(number, 1, option)[0];
    };
    ranges.push_back({bound(part.substr(0, colon), 0), bound(part.substr(colon + 1), -1)});
  }
  if (ranges.size() != 3) throw CLI::ValidationError(option, "expected three ranges");
  return ranges;
}

}  // namespace mesamis
