// SPDX-License-Identifier: Apache-2.0
#include "slicer_description.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "mesamis/base/version.h"
#include "mesamis/base/written_number.h"
#include "mesamis/files/xml_text.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/object/tissue.h"
#include "scan.h"
#include "settings_options.h"
#include "slicer_progress.h"

namespace mesamis {
namespace {

/// One parameter as Slicer shows it. Slicer wants flags and names of letters, digits and
/// underscores.
struct ModuleParameter {
  std::string tag;           ///< its kind: image, geometry, double, ...
  std::string name;          ///< and flag: --name
  std::string label;         ///< beside its field
  std::string help;          ///< where the mouse rests
  std::string attributes{};  ///< of the tag, with a blank before each
  std::string channel{};     ///< input or output; empty: a plain value
  std::string start{};       ///< default; empty: none
  std::string index{};       ///< the place of one that must be given; empty: it has a flag
  std::vector<std::string> elements{};       ///< of an enumeration
  std::string minimum{}, maximum{}, step{};  ///< empty: no constraints
  bool has_flag = true;                      ///< false: with an index, or a result
};

std::string element(const std::string& tag, const std::string& text, const char* indent) {
  return indent + ("<" + tag + ">") + xml_escaped(text) + "</" + tag + ">\n";
}

std::string constraints(const ModuleParameter& p) {
  if (p.step.empty()) return "";
  return "      <constraints>\n" + element("minimum", p.minimum, "        ") +
         element("maximum", p.maximum, "        ") + element("step", p.step, "        ") +
         "      </constraints>\n";
}

std::string xml_of(const ModuleParameter& p) {
  constexpr const char* kIndent = "      ";
  std::string xml = "    <" + p.tag + p.attributes + ">\n";
  xml += element("name", p.name, kIndent);
  if (p.has_flag && p.index.empty()) xml += element("longflag", p.name, kIndent);
  xml += element("label", p.label, kIndent) + element("description", p.help, kIndent);
  if (!p.channel.empty()) xml += element("channel", p.channel, kIndent);
  if (!p.index.empty()) xml += element("index", p.index, kIndent);
  if (!p.start.empty()) xml += element("default", p.start, kIndent);
  for (const std::string& word : p.elements) xml += element("element", word, kIndent);
  return xml + constraints(p) + "    </" + p.tag + ">\n";
}

struct ModuleGroup {
  std::string label, help;
  bool advanced = false;  ///< closed until it is opened
  std::vector<ModuleParameter> parameters{};
};

std::string xml_of(const ModuleGroup& group) {
  std::string xml = group.advanced ? "  <parameters advanced=\"true\">\n" : "  <parameters>\n";
  xml += element("label", group.label, "    ") + element("description", group.help, "    ");
  for (const ModuleParameter& parameter : group.parameters) xml += xml_of(parameter);
  return xml + "  </parameters>\n";
}

// ---- The settings.

/// "Keep largest"
std::string label_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 32);
  return name;
}

/// Decimals without an exponent: Slicer counts the digits behind the point to know how many to
/// show.
std::string plain(double value) {
  char text[400];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr;
  return {text, end};
}

std::size_t decimals_of(const std::string& number) {
  const std::size_t point = number.find('.');
  return point == std::string::npos ? 0 : number.size() - point - 1;
}

/// A number in a range, for a slider. Others are fields of text: "auto", lists, and ranges of more
/// steps than the slider counts.
bool has_slider(const Setting& setting) {
  return setting.count == 1 && setting.words.empty() && setting.exceptions.empty();
}

/// Sets the range and the step, if a slider has steps enough.
bool set_slider(ModuleParameter& p, const Setting& setting) {
  constexpr double kMostSteps = 1e9;
  p.minimum = plain(setting.low);
  p.maximum = plain(setting.high);
  const std::size_t decimals =
      std::max({decimals_of(p.minimum), decimals_of(p.maximum), decimals_of(p.start)});
  const double step =
      setting.whole ? 1 : std::pow(10.0, -static_cast<double>(std::max(decimals, std::size_t{1})));
  if (std::max(std::abs(setting.low), std::abs(setting.high)) > kMostSteps * step) return false;
  p.step = plain(step);
  return true;
}

ModuleParameter number_parameter(ModuleParameter p, const Setting& setting) {
  const SettingValue value = setting.get({});
  p.tag = "string";
  p.start = text_of(setting, value);
  if (!has_slider(setting)) return p;
  ModuleParameter slider = p;
  slider.tag = setting.whole ? "integer" : "double";
  slider.start = plain(std::get<std::vector<double>>(value)[0]);
  return set_slider(slider, setting) ? slider : p;
}

/// Slicer says nothing of a switch that is off: what is on is turned off by another switch.
ModuleParameter switch_parameter(ModuleParameter p, const Setting& setting) {
  p.tag = "boolean";
  p.start = "false";
  if (!std::get<bool>(setting.get({}))) return p;
  p.name = option_against(setting, '_').substr(2);
  p.label = label_of(p.name);
  p.help = "Not: " + p.help;
  return p;
}

std::string range_text(const Setting& setting) {
  if (setting.count == 0) return "";
  std::string text = ". " + forms_of(setting) + ", " + number_text(setting.low) + " to " +
                     number_text(setting.high);
  for (const double more : setting.exceptions) text += " or " + number_text(more);
  return text;
}

ModuleParameter setting_parameter(const Setting& setting) {
  ModuleParameter p{.tag = "string",
                    .name = setting.name,
                    .label = label_of(setting.name),
                    .help = help_of(setting)};
  if (!setting.automatic.empty()) p.help += ". auto: " + setting.automatic;
  if (is_switch(setting)) return switch_parameter(p, setting);
  if (setting.count == 0) {
    p.tag = "string-enumeration";
    p.start = text_of(setting, setting.get({}));
    p.elements = setting.words;
    return p;
  }
  p = number_parameter(p, setting);
  if (p.tag == "string") p.help += range_text(setting);
  return p;
}

/// The settings in their groups; what most users leave alone is closed.
std::vector<ModuleGroup> setting_groups() {
  std::vector<ModuleGroup> groups;
  for (const Setting& setting : setting_table()) {
    if (groups.empty() || groups.back().label != setting.group) {
      groups.push_back({setting.group, setting.group + " settings", setting.group != "Surface"});
    }
    groups.back().parameters.push_back(setting_parameter(setting));
  }
  std::stable_partition(groups.begin(), groups.end(),
                        [](const ModuleGroup& group) { return !group.advanced; });
  return groups;
}

// ---- What a run reads, writes and gives back.

ModuleGroup files_group() {
  return {"Input and output",
          "The scan, and what is made of it",
          false,
          {{.tag = "image",
            .name = "scan",
            .label = "Scan",
            .help = "The volume to segment",
            .attributes = " type=\"scalar\"",
            .channel = "input",
            .index = "0"},
           {.tag = "geometry",
            .name = "model",
            .label = "Model",
            .help = "The surface: closed, in millimetres",
            .attributes = " type=\"model\" fileExtensions=\".vtp,.stl,.ply,.obj\"",
            .channel = "output",
            .index = "1"},
           {.tag = "image",
            .name = "labelmap",
            .label = "Label map",
            .help = "What was found, voxel by voxel on the grid of the scan",
            .attributes = " type=\"label\" fileExtensions=\".nrrd\"",
            .channel = "output"},
           {.tag = "geometry",
            .name = "mesh",
            .label = "Tetrahedra",
            .help = "The adapted mesh, with the denoised grey values",
            .attributes = " type=\"model\" fileExtensions=\".vtu\"",
            .channel = "output"},
           {.tag = "file",
            .name = "report",
            .label = "Report",
            .help = "Everything about the run, as JSON",
            .attributes = " fileExtensions=\".json\"",
            .channel = "output"},
           {.tag = "boolean",
            .name = "error",
            .label = "Expected error",
            .help = "The model carries the error expected at each point, mm: expected_error",
            .start = "false"}}};
}

std::vector<std::string> tissue_words() {
  std::vector<std::string> words{kAnyBright};
  for (const Tissue& tissue : tissue_table()) words.push_back(tissue.name);
  return words;
}

std::string tissue_help() {
  std::string help = std::string(kAnyBright) + ": all that is bright";
  for (const Tissue& tissue : tissue_table()) help += "; " + tissue.name + ": " + tissue.help;
  return help;
}

ModuleGroup object_group() {
  const std::string lps = " coordinateSystem=\"lps\"";
  return {"Which object",
          "Which object of the scan to segment: docs/objects.md and docs/labels.md",
          false,
          {{.tag = "string-enumeration",
            .name = "tissue",
            .label = "Tissue",
            .help = tissue_help(),
            .start = kAnyBright,
            .elements = tissue_words()},
           {.tag = "string-enumeration",
            .name = "modality",
            .label = "Modality",
            .help = "Of the scan, which Slicer's temporary files do not state; auto: by its values",
            .start = kStatedModality,
            .elements = modality_words()},
           {.tag = "string",
            .name = "values",
            .label = "Values",
            .help = "Instead of a tissue: LO:HI in native units; one end may be left out"},
           {.tag = "image",
            .name = "labels",
            .label = "Labels",
            .help = "Label map whose labels choose the objects; the scan places their surfaces",
            .attributes = " type=\"label\"",
            .channel = "input"},
           {.tag = "string-vector",
            .name = "label",
            .label = "Chosen labels",
            .help = "Numbers or names of labels, commas between; empty: all"},
           {.tag = "image",
            .name = "mask",
            .label = "Mask",
            .help = "Label map: only what lies near a marked voxel",
            .attributes = " type=\"label\"",
            .channel = "input"},
           {.tag = "string",
            .name = "margin",
            .label = "Margin",
            .help = "How far labels may be wrong, or around the mask, mm; empty: chosen"},
           {.tag = "point",
            .name = "seed",
            .label = "Seeds",
            .help = "Points: the island with this point alone; several split what touches",
            .attributes = " multiple=\"true\"" + lps},
           {.tag = "region",
            .name = "region",
            .label = "Region",
            .help = "The part of the scan; of a rotated region the smallest upright box around it",
            .attributes = " multiple=\"false\"" + lps},
           {.tag = "boolean",
            .name = "keep_surroundings",
            .label = "Keep surroundings",
            .help = "Leave table and head rest, which go where a patient is found in CT",
            .start = "false"}}};
}

ModuleGroup limits_group() {
  return {"Run",
          "Where the settings start, and what the run may take",
          true,
          {{.tag = "string-enumeration",
            .name = "preset",
            .label = "Preset",
            .help = "Settings to start from; settings above that differ from their default win",
            .start = "default",
            .elements = preset_names()},
           {.tag = "file",
            .name = "settings",
            .label = "Settings file",
            .help = "Settings, or the report of a run to repeat; settings above that differ from "
                    "their default win",
            .attributes = " fileExtensions=\".json\"",
            .channel = "input"},
           {.tag = "string",
            .name = "time_limit",
            .label = "Time limit",
            .help = "Seconds after which no further mesh is begun; empty: none"},
           {.tag = "string",
            .name = "threads",
            .label = "Threads",
            .help = "At most; empty: all. The result is the same for any number"},
           {.tag = "string",
            .name = "memory",
            .label = "Memory",
            .help = "That the run may take, GB; empty: what is free"}}};
}

ModuleGroup results_group() {
  ModuleGroup group{"Results", "Figures of the last run", false};
  for (const std::string name : kSlicerResults) {
    const bool whole = name == "result_objects" || name == "result_triangles";
    group.parameters.push_back({.tag = whole                      ? "integer"
                                       : name == "result_outcome" ? "string"
                                                                  : "double",
                                .name = name,
                                .label = label_of(name.substr(name.find('_') + 1)),
                                .help = "Of the whole model; empty where there is none",
                                .channel = "output",
                                .has_flag = false});
  }
  return group;
}

std::string head() {
  constexpr const char* kIndent = "  ";
  return element("category", "Segmentation", kIndent) +
         element("title", "mesamis: surface from a scan", kIndent) +
         element("description",
                 "From a CT, MR or micro-CT volume to a closed, printable surface and an adapted "
                 "mesh. Not a medical device: not for diagnosis or treatment.",
                 kIndent) +
         element("version", version(), kIndent) + element("documentation-url", "", kIndent) +
         element("license", "Apache-2.0", kIndent) +
         element("contributor", "the mesamis contributors", kIndent) +
         element("acknowledgements",
                 "The method is that of: F. Clerici, N. Ferro, S. Marconi, S. Micheletti, E. "
                 "Negrello, S. Perotto, Anisotropic adapted meshes for image segmentation: "
                 "application to 3D medical data, MOX Report 48/2020, Politecnico di Milano.",
                 kIndent);
}

}  // namespace

std::vector<std::string> modality_words() {
  std::vector<std::string> words{kStatedModality};
  words.insert(words.end(), kModalities.begin(), kModalities.end());
  return words;
}

std::string slicer_description() {
  std::string xml = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<executable>\n" + head();
  xml += xml_of(files_group()) + xml_of(object_group());
  for (const ModuleGroup& group : setting_groups()) xml += xml_of(group);
  return xml + xml_of(limits_group()) + xml_of(results_group()) + "</executable>\n";
}

}  // namespace mesamis
