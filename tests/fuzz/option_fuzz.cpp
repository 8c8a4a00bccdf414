// SPDX-License-Identifier: Apache-2.0
// The parsers of the command line, a target per command. Lines of the input are arguments. They are
// parsed and never run: a line sets an action, or is refused in one line of at most 500 characters.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "arguments.h"
#include "body_options.h"
#include "command_line.h"
#include "fuzz_target.h"
#include "label_options.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/method/setting_table.h"
#include "place_options.h"
#include "settings_options.h"

namespace mesamis {
namespace {

using Arguments = std::vector<std::string>;

/// Arguments end at line breaks and zero bytes.
Arguments arguments_of(Arguments first, std::string_view bytes) {
  constexpr std::size_t kMost = 100;
  while (!bytes.empty() && first.size() < kMost) {
    const std::size_t end =
        std::min(bytes.find_first_of(std::string_view("\n\0", 2)), bytes.size());
    first.emplace_back(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  return first;
}

std::vector<const char*> pointers_to(const Arguments& arguments) {
  std::vector<const char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  return pointers;
}

void require_usage_line(const std::string& message) {
  constexpr std::size_t kLongest = 470;  // with what the log puts before it, 500
  require_one_line(line_of(message), kLongest);
}

using AddCommands = void (*)(CLI::App&, CommonOptions&, Action&);

/// @param add  all commands, or one and the common options: most of the time goes into this.
void parse_program(AddCommands add, const Arguments& arguments) {
  CLI::App app("fuzz");
  CommonOptions common;
  Action action;
  add(app, common, action);
  const std::vector<const char*> pointers = pointers_to(arguments);
  const auto count = static_cast<int>(pointers.size());
  try {
    app.parse(count, pointers.data());
    require_law(static_cast<bool>(action), "a line that names no command was taken");
    require_law(common.threads >= 0 && common.limits.memory_gb >= 0, "common options out of range");
  } catch (const CLI::Success&) {  // --help, --version
    require_law(!app.help().empty(), "no help");
  } catch (const CLI::ParseError& error) {
    require_usage_line(usage_message(app, error, count, pointers.data()));
  }
}

void run_program(std::string_view bytes) {
  parse_program(add_commands, arguments_of({"mesamis"}, bytes));
}

template <AddCommands kAdd>
void run_command(std::string_view bytes) {
  constexpr AddCommands kAddAlone = [](CLI::App& app, CommonOptions& common, Action& action) {
    add_common_options(app, common);
    kAdd(app, common, action);
  };
  static const std::string name = [] {
    CLI::App app("fuzz");
    CommonOptions common;
    Action action;
    kAdd(app, common, action);
    return app.get_subcommands({}).at(0)->get_name();
  }();
  parse_program(kAddAlone, arguments_of({"mesamis", name}, bytes));
}

/// The text of a value gives the value back.
void require_texts(const SettingsArguments& arguments) {
  for (const auto& [name, text, option] : arguments.overrides) {
    const Setting& setting = find_setting(name);
    const SettingValue value = parse_value(setting, text);
    require_law(parse_value(setting, text_of(setting, value)) == value,
                "a value whose text gives another one");
  }
}

struct Texts {
  SettingsArguments settings;
  PlaceArguments places;
  LabelArguments labels;
  Frame frame = Frame::kLps;
};

/// What the commands do with the texts of settings and places before a file is read.
void check_texts(Texts texts) {
  texts.settings.file.clear();  // the readers have targets of their own
  const Settings settings = settings_of(texts.settings);
  require_texts(texts.settings);
  require_places(texts.places, texts.labels, settings);
  texts.places.mask.clear();
  if (texts.places.remove != "body") texts.places.remove.clear();
  read_request({texts.places, texts.labels, texts.frame}, settings);
}

void run_texts(std::string_view bytes) {
  const Arguments arguments = arguments_of({"mesamis"}, bytes);
  const std::vector<const char*> pointers = pointers_to(arguments);
  CLI::App app("fuzz");
  Texts texts;
  add_settings_options(app, texts.settings);
  add_place_options(app, texts.places);
  add_label_options(app, texts.labels);
  add_frame_option(app, texts.frame);
  try {
    app.parse(static_cast<int>(pointers.size()), pointers.data());
    check_texts(std::move(texts));
  } catch (const CLI::ParseError& error) {
    require_usage_line(error.what());
  }
}

/// What was read of sets of faces can be looked for.
void require_query(const FaceQuery& query) {
  using enum FaceQuery::Kind;
  require_law(is_solver_name(query.name), "a set with a name that solvers refuse");
  const bool at_end = query.kind == kTop || query.kind == kBottom;
  require_law(!at_end || (query.depth > 0 && query.axis >= 0 && query.axis < 3),
              "a depth or an axis out of range");
  require_law(query.kind != kNormal || std::abs(norm(query.normal) - 1) < 1e-9,
              "a direction that is not of length one");
  require_law(query.kind != kBetween || (query.objects[0] > 0 && query.objects[1] > 0),
              "an object that there cannot be");
}

/// A law and a calibration give stiffness that rises with the native value.
void require_material(const MaterialOptions& options) {
  require_law(options.law && options.calibration, "a material without law or calibration");
  require_law(std::isfinite(options.calibration->offset) && options.calibration->slope > 0,
              "a calibration that does not rise");
  require_law(!options.law->ranges.empty(), "a law without a range");
  const double low = modulus_at(*options.law, 0.1), high = modulus_at(*options.law, 1);
  require_law(low >= 0 && high >= low, "a law whose modulus falls");
}

/// What `segment` does with the texts of bodies before a file is read.
void run_body(std::string_view bytes) {
  const Arguments arguments = arguments_of({"mesamis"}, bytes);
  const std::vector<const char*> pointers = pointers_to(arguments);
  CLI::App app("fuzz");
  BodyArguments body;
  add_body_options(app, body);
  try {
    app.parse(static_cast<int>(pointers.size()), pointers.data());
    body.files = {"a.inp"};
    const BodyWishes wishes = element_request(body, Frame::kLps, 0).wishes;
    body.files.clear();  // no file is asked for
    for (const FaceQuery& query : wishes.sets) require_query(query);
    if (wishes.material) require_material(*wishes.material);
    require_body(body);
  } catch (const CLI::ParseError& error) {
    require_usage_line(error.what());
  }
}

constexpr FuzzTarget kTargets[] = {
    {"options_program", run_program},
    {"options_body", run_body},
    {"options_baseline", run_command<add_baseline_command>},
    {"options_bids", run_command<add_bids_command>},
    {"options_compare", run_command<add_compare_command>},
    {"options_decimate", run_command<add_decimate_command>},
    {"options_info", run_command<add_info_command>},
    {"options_phantom", run_command<add_phantom_command>},
    {"options_picture", run_command<add_picture_command>},
    {"options_remesh", run_command<add_remesh_command>},
    {"options_segment", run_command<add_segment_command>},
    {"options_settings", run_command<add_settings_command>},
    {"options_slice", run_command<add_slice_command>},
    {"options_slicer_segment", run_command<add_slicer_segment_command>},
    {"options_study", run_command<add_study_command>},
    {"options_texts", run_texts},
};

}  // namespace

std::span<const FuzzTarget> fuzz_targets() { return kTargets; }

std::vector<std::string> fuzz_words() {
  CLI::App app("fuzz");
  CommonOptions common;
  Action action;
  add_commands(app, common, action);
  std::set<std::string> words;
  for (const CLI::App* command : app.get_subcommands({})) {
    words.insert(command->get_name());
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) words.insert("--" + name);
    }
  }
  for (const Setting& setting : setting_table()) {
    words.insert(setting.words.begin(), setting.words.end());
    words.insert(text_of(setting, setting.get({})));
  }
  words.erase("");
  return {words.begin(), words.end()};
}

}  // namespace mesamis
