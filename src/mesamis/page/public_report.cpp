// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/public_report.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "mesamis/files/refuse.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/page/figures.h"

namespace mesamis::detail::page {
namespace {

using nlohmann::json;

/// The extension of a file, short and of letters and digits; with it ".nii.gz".
std::string extension_of(const std::string& path) {
  constexpr std::size_t kLongest = 6;
  const std::filesystem::path file(path);
  std::string extension = file.extension().string();
  const bool plain = extension.size() > 1 && extension.size() <= kLongest &&
                     std::isdigit(static_cast<unsigned char>(extension[1])) == 0 &&
                     std::all_of(extension.begin() + 1, extension.end(),
                                 [](unsigned char c) { return std::isalnum(c) != 0; });
  if (!plain) return {};
  return extension == ".gz" ? extension_of(file.stem().string()) + extension : extension;
}

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  if (what.empty()) return;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) {
    text.replace(at, what.size(), with);
  }
}

/// Warnings of the method hold numbers and names of tissues alone. Those of readers may hold names
/// of files and free text of a scan.
bool is_of_method(const std::string& warning) {
  return warning.starts_with("tissue: ") || warning.starts_with("surface: ");
}

/// A name of a file with its folder, or any other name, would be between these.
bool may_name(const std::string& text) {
  return text.find_first_of("/\\'\"`") != std::string::npos;
}

/// Warnings that name nobody; of the others their number.
/// @param of_reader  those of the scan's reader.
json shown_warnings(const json& warnings, const json& of_reader) {
  json shown = json::array();
  std::size_t hidden = 0;
  for (const json& warning : warnings) {
    const std::string text = warning.is_string() ? warning.get<std::string>() : std::string();
    const bool read = of_reader.is_array() &&
                      std::find(of_reader.begin(), of_reader.end(), warning) != of_reader.end();
    if (!read && is_of_method(text) && !may_name(text)) {
      shown.push_back(warning);
    } else {
      ++hidden;
    }
  }
  if (hidden > 0) {
    shown.push_back(std::to_string(hidden) + (hidden == 1 ? " warning" : " warnings") +
                    " hidden, which may name files or people: see the report or --html-names");
  }
  return shown;
}

void hide_warnings(json& report) {
  const json of_run = entry(report, "/warnings"), of_reader = entry(report, "/input/warnings");
  if (!of_run.is_null()) report["warnings"] = shown_warnings(of_run, of_reader);
  if (!of_reader.is_null()) report["input"]["warnings"] = shown_warnings(of_reader, of_reader);
}

void hide_message(json& report) {
  const json message = entry(report, "/verdict/message");
  if (!message.is_string() || !may_name(message.get<std::string>())) return;
  report["verdict"]["message"] =
      "Not all was kept that the run promised: see the report or --html-names";
}

void hide_paths(json& value) {
  if (value.is_object() && value.contains("path") && value["path"].is_string()) {
    value["path"] = "(not shown)" + extension_of(value["path"].get<std::string>());
  }
  if (!value.is_structured()) return;
  for (json& inside : value) hide_paths(inside);
}

/// Options whose values say nothing of a patient.
constexpr std::array kKept{"--frame",
                           "--label",
                           "--tissue",
                           "--seed",
                           "--box",
                           "--margin",
                           "--bins",
                           "--mesh-region",
                           "--surface-quality",
                           "--least-size",
                           "--preset",
                           "--element",
                           "--element-size",
                           "--wall-elements",
                           "--spacing",
                           "--raw",
                           "--element-gradation",
                           "--skin-tolerance",
                           "--material",
                           "--calibration",
                           "--ash",
                           "--material-gap",
                           "--material-rim",
                           "--poisson",
                           "--gmsh-version",
                           "--time-limit",
                           "--set"};
constexpr std::array kFlags{"--error", "--resample", "--keep-surroundings", "--allow-outside"};
/// They change no result; the first ones have no value.
constexpr std::array kLeftOut{"--quiet",  "--log-json", "--html-names", "--threads",
                              "--memory", "--html",     "--pictures"};
constexpr std::size_t kWithoutValue = 3;

template <class List>
bool holds(const List& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

const Setting* setting_of(const std::string& option) {
  for (const Setting& setting : setting_table()) {
    std::string name = "--" + setting.name;
    std::replace(name.begin(), name.end(), '_', '-');
    const bool is_switch = std::holds_alternative<bool>(setting.get(Settings{}));
    if (option == name || (is_switch && option == "--no-" + name.substr(2))) return &setting;
  }
  return nullptr;
}

bool has_value(const std::string& option) {
  if (holds(kFlags, option) || std::find(kLeftOut.begin(), kLeftOut.begin() + kWithoutValue,
                                         option) != kLeftOut.begin() + kWithoutValue) {
    return false;
  }
  const Setting* setting = setting_of(option);
  return setting == nullptr || !std::holds_alternative<bool>(setting->get(Settings{}));
}

bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         std::isalpha(static_cast<unsigned char>(word[word[1] == '-' && word.size() > 2 ? 2 : 1]));
}

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("-_./:,=+@%").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string text = word;
  replace_all(text, "'", "'\\''");
  return "'" + text + "'";
}

/// What stands for a value that a user may have chosen freely.
std::string stand_in(const std::string& option, const std::string& value) {
  std::string name = option == "-o" || option == "--output" ? "surface" : option;
  name.erase(0, name.find_first_not_of('-'));
  const std::string extension = extension_of(value);
  if (!extension.empty()) return name + extension;
  return upper(name);
}

class Repeated {
 public:
  /// @param scan  its path, as it stands on the command line; empty: not known.
  Repeated(bool names, std::string scan) : names_(names), scan_(std::move(scan)) {}

  void add(const std::vector<std::string>& words) {
    for (std::size_t n = 0; n < words.size(); ++n) {
      if (!is_option(words[n])) {
        add_word(words[n], n == 0);
        continue;
      }
      // "--crop=0:5", "-oFILE"
      const bool glued = words[n][1] != '-' && words[n].size() > 2;
      const std::size_t end = glued ? 2 : words[n].find('=');
      option_ = words[n].substr(0, end);
      const bool joined = end != std::string::npos;
      const bool follows = !joined && has_value(option_) && n + 1 < words.size();
      if (!holds(kLeftOut, option_)) append(option_);
      if (joined) add_value(words[n].substr(end + (glued ? 0 : 1)));
      if (follows) add_value(words[++n]);
    }
  }
  const std::string& text() const { return text_; }

 private:
  /// A word that is no option: the command, the scan, or one more value of an option.
  void add_word(const std::string& word, bool first) {
    if (names_) return append(word);
    if (first) return append("segment");
    if (option_.empty() || word == scan_ || !has_value(option_)) return append("SCAN");
    add_value(word);
  }
  void add_value(const std::string& value) {
    if (holds(kLeftOut, option_)) return;
    const bool harmless = setting_of(option_) != nullptr || holds(kKept, option_);
    append(names_ || harmless ? value : stand_in(option_, value));
  }
  void append(const std::string& word) { text_ += " " + quoted(word); }

  bool names_;
  std::string scan_, option_;  // the last option
  std::string text_ = "mesamis";
};

/// Without an entry of an object, where there is such an object.
void drop(json& report, const char* object, const char* entry) {
  if (report.contains(object) && report[object].is_object()) report[object].erase(entry);
}

/// The scan's path as the report has it.
std::string scan_of(const json& report) {
  const json& path = entry(report, "/input/path");
  return path.is_string() ? path.get<std::string>() : "";
}

}  // namespace

json public_report(json report, bool names) {
  if (!report.is_object()) return json::object();
  for (const char* key : {"seconds", "seconds_parts", "peak_memory_mb", "command"}) {
    report.erase(key);
  }
  drop(report, "output", "threads");
  drop(report, "body", "seconds");
  if (report.contains("iterations") && report["iterations"].is_array()) {
    json& passes = report["iterations"];
    for (std::size_t n = 0; n < passes.size(); ++n) {
      if (passes[n].is_object()) passes[n].erase("seconds");
    }
  }
  if (names) return report;
  hide_warnings(report);
  hide_message(report);
  hide_paths(report);
  return report;
}

std::string repeat_command(const json& report, bool names) {
  const json words = report.is_object() ? report.value("command", json()) : json();
  if (!words.is_array() || words.empty()) {
    return "mesamis segment SCAN --settings report.json -o surface.stl";
  }
  std::vector<std::string> texts;
  for (const json& word : words) {
    if (word.is_string()) texts.push_back(word.get<std::string>());
  }
  Repeated repeated(names, scan_of(report));
  repeated.add(texts);
  return repeated.text();
}

}  // namespace mesamis::detail::page
