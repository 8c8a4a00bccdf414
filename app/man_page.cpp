// SPDX-License-Identifier: Apache-2.0
#include "man_page.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "command_guide.h"
#include "commands.h"
#include "mesamis/base/version.h"
#include "mesamis/method/setting_table.h"
#include "option_facts.h"

namespace mesamis {
namespace {

/// Beyond this a line of the source is a fault to those who check pages.
constexpr std::size_t kLineLength = 76;

/// The statuses of commands.h in words.
constexpr std::array<std::pair<int, const char*>, 6> kStatuses{{
    {kExitDone, "Done."},
    {kExitInternal, "An internal error: a bug."},
    {kExitUsage, "The command line was refused."},
    {kExitInput, "An input was refused, or an output cannot be written."},
    {kExitNotConverged,
     "A limit came first or a promise is unmet: outputs are written, and the "
     "report says so."},
    {kExitNotClosed, "A surface that should be closed is not: outputs are written."},
}};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '`':
        out += "\\(ga";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// A page while it is written. Its text is wrapped and cannot be taken for commands of roff.
class Page {
 public:
  void line(const std::string& roff) { text_ += roff + "\n"; }
  void section(const std::string& title) { line(".SH " + escaped(in_capitals(title))); }
  void tagged(const std::string& tag, const std::string& text) {
    line(".TP");
    line(tag);
    prose(text);
  }

  void prose(const std::string& text) {
    std::istringstream words(text);
    std::string current;
    for (std::string word; words >> word;) {
      word = escaped(word);
      if (!current.empty() && current.size() + 1 + word.size() > kLineLength) end_line(current);
      current += (current.empty() ? "" : " ") + word;
    }
    if (!current.empty()) end_line(current);
  }

  const std::string& text() const { return text_; }

 private:
  void end_line(std::string& current) {
    line((current[0] == '.' ? "\\&" : "") + current);
    current.clear();
  }

  std::string text_;
};

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string page_name(const CLI::App* command) {
  return command == nullptr ? "mesamis" : "mesamis-" + command->get_name();
}

void write_head(Page& page, const CLI::App* command, const std::string& description,
                const std::string& date) {
  page.line(".\\\" SPDX-License-Identifier: Apache-2.0");
  page.line(".TH " + in_capitals(escaped(page_name(command))) + " 1 \"" + date + "\" \"mesamis " +
            version() + "\" \"mesamis\"");
  page.section("Name");
  // What finds pages by their purpose wants a small letter.
  std::string purpose = description;
  purpose[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(purpose[0])));
  page.prose(page_name(command) + " - " + purpose);
}

/// Options that must be given, then those that may, then what is named by its place.
void write_synopsis(Page& page, const CLI::App& command, const std::vector<OptionFacts>& options) {
  page.section("Synopsis");
  std::string line = bold("mesamis " + command.get_name());
  for (const OptionFacts& option : options) {
    if (!option.required || option.positional) continue;
    line += " " + bold(option.names.front()) + " " + italic(option.value);
  }
  line += " [" + italic("OPTION") + "...]";
  for (const OptionFacts& option : options) {
    if (!option.positional) continue;
    const std::string name = italic(in_capitals(option.names.front()));
    line += option.required ? " " + name : " [" + name + "]";
  }
  page.line(line);
}

std::string tag_of(const OptionFacts& option) {
  if (option.positional) return italic(in_capitals(option.names.front()));
  std::string tag;
  for (const std::string& name : option.names) tag += (tag.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) tag += " " + italic(option.value);
  return option.repeated ? tag + " ..." : tag;
}

/// "--no-restore" beside "--restore": which says so itself.
bool is_opposite(const OptionFacts& option, const std::string& other) {
  const std::string& name = option.names.front();
  return name == "--no-" + other.substr(2) || other == "--no-" + name.substr(2);
}

/// The help as sentences, with what the parser alone knows behind it.
std::string sentences_of(const OptionFacts& option) {
  std::string text = option.help;
  if (text.find('\n') == std::string::npos && !text.ends_with('.')) text += ".";
  if (!option.range.empty()) text += " Accepted: " + option.range + ".";
  if (option.required) text += " Required.";
  for (const std::string& other : option.excludes) {
    if (!is_opposite(option, other)) text += " Not together with " + other + ".";
  }
  return text;
}

/// A table in the help keeps its lines.
void write_option(Page& page, const OptionFacts& option) {
  std::istringstream lines(sentences_of(option));
  std::string first;
  std::getline(lines, first);
  page.tagged(tag_of(option), first);
  for (std::string rest; std::getline(lines, rest);) {
    page.line(".br");
    page.prose(rest);
  }
}

/// A section for each group of the help.
void write_options(Page& page, const std::vector<OptionFacts>& options) {
  std::string group;
  for (const OptionFacts& option : options) {
    if (option.group != group) {
      group = option.group;
      const bool complete = group == "Positionals" || group.starts_with("Options");
      page.section(complete ? group : group + " options");
    }
    write_option(page, option);
  }
}

void write_examples(Page& page, const CommandGuide& guide) {
  if (guide.examples.empty()) return;
  page.section("Examples");
  for (const CommandExample& example : guide.examples) {
    page.line(".TP");
    page.prose(example.purpose + ":");
    page.prose(example.line);
  }
}

void write_statuses(Page& page) {
  page.section("Exit status");
  for (const auto& [status, meaning] : kStatuses) {
    page.tagged(bold(std::to_string(status)), meaning);
  }
}

void write_see_also(Page& page, const CLI::App& program, const CLI::App* self) {
  std::vector<std::string> names;
  if (self != nullptr) names.push_back(page_name(nullptr));
  for (const CLI::App* command : shown_commands(program)) {
    if (command != self) names.push_back(page_name(command));
  }
  page.section("See also");
  for (const std::string& name : names) {
    page.line(".BR " + escaped(name) + " (1)" + (name == names.back() ? "" : ","));
  }
}

/// The range of a setting in words; empty for a switch or words alone.
std::string range_of(const Setting& setting) {
  if (setting.count == 0) return "";
  std::ostringstream text;
  text << setting.low << " to " << setting.high;
  for (const double other : setting.exceptions) text << ", " << other;
  return " Range: " + text.str() + ".";
}

/// All that the table knows of each setting, under its name in files.
void write_settings(Page& page) {
  page.section("Settings");
  page.prose(
      "Names as files and reports have them. The option of a command has hyphens instead: "
      "max_tets is --max-tets.");
  for (const Setting& setting : setting_table()) {
    std::string text = setting.help + "." + range_of(setting);
    text += " Default: " + text_of(setting, setting.get({})) + ".";
    if (!setting.paper.empty()) text += " In the preset paper: " + setting.paper + ".";
    if (!setting.unit.empty()) text += " Unit: " + setting.unit + ".";
    if (!setting.automatic.empty()) text += " Automatic: " + setting.automatic + ".";
    page.tagged(bold(setting.name) + " " + italic(forms_of(setting)), text);
  }
}

ManPage command_page(const CLI::App& program, const CLI::App& command, const std::string& date) {
  const std::vector<OptionFacts> options = option_facts(command);
  Page page;
  write_head(page, &command, command.get_description(), date);
  write_synopsis(page, command, options);
  page.section("Description");
  page.prose(command.get_description() + ".");
  page.line(".PP");
  page.prose(
      "Options of every command, such as --threads, --quiet and --memory, are in the page "
      "of the program.");
  write_options(page, options);
  if (command.get_name() == "settings") write_settings(page);
  write_examples(page, guide_of(command.get_name()));
  write_statuses(page);
  write_see_also(page, program, &command);
  return {page_name(&command) + ".1", page.text()};
}

ManPage program_page(const CLI::App& program, const std::string& date) {
  Page page;
  write_head(page, nullptr, program.get_description(), date);
  page.section("Synopsis");
  page.line(bold("mesamis") + " [" + italic("OPTION") + "...] " + italic("COMMAND") + " [" +
            italic("ARGUMENT") + "...]");
  page.section("Description");
  page.prose(
      "mesamis reads a scan: CT, MR or micro-CT. It writes a closed triangle surface that "
      "can be printed, and an adapted tetrahedral mesh that carries the denoised grey "
      "values. The same input gives the same bytes, on any number of threads.");
  page.section("Commands");
  for (const CLI::App* command : shown_commands(program)) {
    page.tagged(bold(command->get_name()), command->get_description() + ".");
  }
  write_options(page, option_facts(program));
  write_statuses(page);
  page.section("Notes");
  page.prose(
      "mesamis is not a medical device: do not use its results for diagnosis or "
      "treatment.");
  write_see_also(page, program, nullptr);
  return {page_name(nullptr) + ".1", page.text()};
}

}  // namespace

std::vector<ManPage> man_pages(const CLI::App& program, const std::string& date) {
  std::vector<ManPage> pages{program_page(program, date)};
  for (const CLI::App* command : shown_commands(program)) {
    pages.push_back(command_page(program, *command, date));
  }
  return pages;
}

}  // namespace mesamis
