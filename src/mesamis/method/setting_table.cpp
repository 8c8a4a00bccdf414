// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/setting_table.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/base/message.h"
#include "mesamis/base/nearest_names.h"
#include "mesamis/base/written_number.h"
#include "mesamis/method/setting_rows.h"

namespace mesamis::detail::method {
namespace {

using Numbers = std::vector<double>;

std::string option_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

[[noreturn]] void refuse_text(const Setting& setting, std::string_view text) {
  throw InputError(message("expected ", forms_of(setting), ", found '", text, "'"));
}

bool read_number(std::string_view text, double& value) {
  const auto number = written_number(text);
  value = number.value_or(0);
  return number.has_value();
}

std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(mark);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// "I0:I1", ":I1", "I0:" or nothing at all.
bool read_range(std::string_view text, Numbers& numbers) {
  const auto bounds = text.empty() ? std::vector<std::string_view>{"", ""} : split(text, ':');
  if (bounds.size() != 2) return false;
  for (std::size_t end = 0; end < 2; ++end) {
    numbers.push_back(end == 0 ? 0 : -1);
    if (!bounds[end].empty() && !read_number(bounds[end], numbers.back())) return false;
  }
  return true;
}

bool read_numbers(const Setting& setting, std::string_view text, Numbers& numbers) {
  for (const std::string_view part : split(text, ',')) {
    if (setting.ranges ? !read_range(part, numbers) : !read_number(part, numbers.emplace_back())) {
      return false;
    }
  }
  if (numbers.size() == 1 && setting.count == 3) numbers.resize(3, numbers[0]);
  return numbers.size() == setting.count;
}

bool is_switch(const Setting& setting) { return setting.count == 0 && setting.words.empty(); }

void check_number(const Setting& setting, double number) {
  if (setting.whole && number != std::floor(number)) {
    throw InputError(message("expected a whole number, found ", number));
  }
  const auto& more = setting.exceptions;
  if (number >= setting.low && number <= setting.high) return;
  if (std::find(more.begin(), more.end(), number) != more.end()) return;
  throw InputError(message("expected ", setting.low, " to ", setting.high, ", found ", number));
}

/// Everything but the setting's name, for errors.
template <class Work>
auto named(const Setting& setting, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    const auto& more = setting.exceptions;
    const bool has_zero = std::find(more.begin(), more.end(), 0.0) != more.end();
    throw InputError(option_name(setting.name) + (has_zero ? " (other than 0)" : "") + ": " +
                     error.what());
  }
}

/// Text in a cell of a Markdown table.
std::string in_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, "\\");
  }
  return text;
}

std::string range_text(const Setting& setting) {
  if (setting.count == 0) return "";
  std::string text = number_text(setting.low) + " to " + number_text(setting.high);
  for (const double more : setting.exceptions) text += " or " + number_text(more);
  return text;
}

std::string page_row(const Setting& setting) {
  const std::string preset = setting.paper.empty() ? "" : "`" + setting.paper + "`";
  std::string meaning = setting.help;
  if (!setting.automatic.empty()) meaning += ". `auto`: " + setting.automatic;
  return message("| `--", option_name(setting.name), "` | `", in_cell(forms_of(setting)), "` | `",
                 in_cell(text_of(setting, setting.get({}))), "` | ", in_cell(preset), " | ",
                 setting.unit, " | ", range_text(setting), " | ", in_cell(meaning), " |\n");
}

}  // namespace

const std::vector<Setting>& setting_table() {
  static const std::vector<Setting> table = build_setting_rows();
  return table;
}

const Setting& find_setting(std::string_view name) {
  std::string wanted(name);
  std::replace(wanted.begin(), wanted.end(), '-', '_');
  for (const Setting& setting : setting_table()) {
    if (setting.name == wanted) return setting;
  }
  std::vector<std::string> names;
  for (const Setting& setting : setting_table()) names.push_back(setting.name);
  throw InputError("there is no setting " + quoted_text(name) + did_you_mean(wanted, names));
}

std::string forms_of(const Setting& setting) {
  std::string forms = setting.form;
  if (setting.count == 0) return forms;
  for (const std::string& word : setting.words) forms += "|" + word;
  return forms;
}

SettingValue parse_value(const Setting& setting, std::string_view text) {
  if (is_switch(setting)) {
    if (text != "yes" && text != "no") refuse_text(setting, text);
    return text == "yes";
  }
  for (const std::string& word : setting.words) {
    if (text == word) return word;
  }
  Numbers numbers;
  if (setting.count == 0 || !read_numbers(setting, text, numbers)) refuse_text(setting, text);
  return numbers;
}

std::string text_of(const Setting& setting, const SettingValue& value) {
  if (const auto* on = std::get_if<bool>(&value)) return *on ? "yes" : "no";
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  std::string text;
  const auto& numbers = std::get<Numbers>(value);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) text += setting.ranges && i % 2 == 1 ? ":" : ",";
    text += number_text(numbers[i]);
  }
  return text;
}

void check_value(const Setting& setting, const SettingValue& value) {
  const auto* word = std::get_if<std::string>(&value);
  const auto* numbers = std::get_if<Numbers>(&value);
  const bool fits = word != nullptr      ? std::find(setting.words.begin(), setting.words.end(),
                                                     *word) != setting.words.end()
                    : numbers != nullptr ? setting.count > 0 && numbers->size() == setting.count
                                         : is_switch(setting);
  if (!fits) refuse_text(setting, text_of(setting, value));
  if (numbers == nullptr) return;
  for (const double number : *numbers) check_number(setting, number);
}

void set_setting(Settings& settings, const Setting& setting, const SettingValue& value) {
  named(setting, [&] { check_value(setting, value); });
  setting.set(settings, value);
}

void require_valid(const Settings& settings) {
  for (const Setting& setting : setting_table()) {
    named(setting, [&] { check_value(setting, setting.get(settings)); });
  }
  const auto& window = settings.window;
  if (window && !(window->low < window->high)) {
    throw InputError(
        message("window: expected low below high, found ", window->low, ",", window->high));
  }
  if (!settings.restore && settings.blur && *settings.blur != std::array<double, 3>{}) {
    const Setting& blur = find_setting("blur");
    throw InputError("blur: expected none where restore is off, found " +
                     text_of(blur, blur.get(settings)));
  }
  if (settings.preview && settings.surface != SurfaceKind::kSolid) {
    throw InputError("preview: expected surface solid, found band");
  }
  if (settings.h_max && *settings.h_max < settings.h_min) {
    throw InputError(
        message("h-max: expected h-min ", settings.h_min, " or more, found ", *settings.h_max));
  }
}

Origin origin_of(const Setting& setting, const Settings& asked) {
  const SettingValue value = setting.get(asked);
  if (is_word(value, "auto")) return Origin::kMeasured;
  return value == setting.get({}) ? Origin::kDefault : Origin::kGiven;
}

Settings preset_settings(std::string_view name) {
  Settings settings;
  if (name == "default") return settings;
  if (name != "paper") {
    throw InputError("preset: expected default or paper, found '" + std::string(name) + "'");
  }
  for (const Setting& setting : setting_table()) {
    if (!setting.paper.empty()) {
      set_setting(settings, setting, parse_value(setting, setting.paper));
    }
  }
  return settings;
}

std::vector<std::string> preset_names() { return {"default", "paper"}; }

std::string settings_page() {
  std::string page =
      "# Settings\n\n"
      "Every setting of a run: an option of `mesamis segment` and `mesamis study`, and, with "
      "underscores for\nhyphens, an entry of the file that `--settings` reads and of a report's "
      "`settings`. A switch is\n`--name` or `--no-name` as an option, `true` or `false` in a file. "
      "One number stands for all three axes.\nAn empty end of a range is the "
      "volume's own bound: `--crop 10:20,,5:`. A file takes such\ntext too (`\"crop\": "
      "\"10:20,,5:\"`), or lists with `null` for an open end: `[[10, 20], null, [5, null]]`.\n"
      "`--preset paper` sets the column of that name; options and files go on top of it.\n\n"
      "This page is made by `mesamis settings --markdown` from the program's table of settings.\n";
  std::string group;
  for (const Setting& setting : setting_table()) {
    if (setting.group != group) {
      group = setting.group;
      page += "\n## " + group +
              "\n\n| option | value | default | paper | unit | range | meaning |\n"
              "|---|---|---|---|---|---|---|\n";
    }
    page += page_row(setting);
  }
  return page;
}

}  // namespace mesamis::detail::method
