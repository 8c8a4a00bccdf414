// SPDX-License-Identifier: Apache-2.0
#include "help_text.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <sstream>
#include <vector>

#include "command_guide.h"
#include "option_facts.h"

namespace mesamis {
namespace {

constexpr std::size_t kWidth = 78;   // columns, with room for " \\" behind them
constexpr std::size_t kIndent = 26;  // of what is said of an option

using Options = std::vector<OptionFacts>;

/// Appends words and breaks the line where the next one would pass the width.
void wrap(std::string& text, std::size_t column, const std::string& words, std::size_t indent) {
  std::istringstream stream(words);
  bool first = true;
  for (std::string word; stream >> word; first = false) {
    if (!first && column + 1 + word.size() > kWidth) {
      text += "\n" + std::string(indent, ' ');
      column = indent;
      first = true;
    }
    text += (first ? "" : " ") + word;
    column += (first ? 0 : 1) + word.size();
  }
}

/// "-o, --output FILE..."
std::string head_of(const OptionFacts& option) {
  std::string head;
  for (const std::string& name : option.names) head += (head.empty() ? "" : ", ") + name;
  if (option.positional) head = in_capitals(head);
  if (!option.value.empty() && !option.positional) head += " " + option.value;
  return option.repeated ? head + "..." : head;
}

/// The help, with what the parser alone knows.
std::string words_of(const OptionFacts& option) {
  std::string words = option.help;
  if (words.ends_with(')') && !option.range.empty()) {
    words.back() = ';';
    words += " " + option.range + ")";
  } else if (!option.range.empty()) {
    words += " (" + option.range + ")";
  }
  return option.required ? words + " (required)" : words;
}

std::string lines_of(const OptionFacts& option) {
  std::string text = "  " + head_of(option);
  if (text.size() + 2 > kIndent) text += "\n" + std::string(kIndent, ' ');
  if (text.size() < kIndent) text.resize(kIndent, ' ');
  std::istringstream lines(words_of(option));
  std::string line;
  for (bool first = true; std::getline(lines, line); first = false) {
    if (!first) text += "\n" + std::string(kIndent, ' ');  // a table in the help keeps its lines
    wrap(text, kIndent, line, kIndent);
  }
  return text + "\n";
}

/// A switch and its opposite in one: "--restore, --no-restore".
Options with_pairs_joined(const Options& options) {
  Options joined;
  for (const OptionFacts& option : options) {
    const bool opposite = !joined.empty() && option.value.empty() && !option.positional &&
                          option.names.front() == "--no-" + joined.back().names.front().substr(2);
    if (opposite) {
      joined.back().names.push_back(option.names.front());
    } else {
      joined.push_back(option);
    }
  }
  return joined;
}

/// All options under the headings of their groups.
std::string groups_text(const Options& options) {
  std::string text, group;
  for (const OptionFacts& option : with_pairs_joined(options)) {
    if (option.positional) continue;
    if (option.group != group) {
      group = option.group;
      text += "\n" + group + ":\n";
    }
    text += lines_of(option);
  }
  return text;
}

bool is_among(const OptionFacts& option, const std::vector<std::string>& names) {
  return std::any_of(option.names.begin(), option.names.end(), [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  });
}

std::string most_used_text(const Options& options, const std::vector<std::string>& names) {
  std::string text = "\nOptions used most:\n";
  for (const std::string& name : names) {
    for (const OptionFacts& option : options) {
      if (is_among(option, {name})) text += lines_of(option);
    }
  }
  return text;
}

std::string usage_line(const CLI::App& command, const Options& options) {
  std::string line = "Usage: mesamis " + command.get_name();
  for (const OptionFacts& option : options) {
    if (option.required && !option.positional) {
      line += " " + option.names.front() + " " + option.value;
    }
  }
  line += " [OPTION]...";
  for (const OptionFacts& option : options) {
    if (!option.positional) continue;
    const std::string name = in_capitals(option.names.front());
    line += option.required ? " " + name : " [" + name + "]";
  }
  return line + "\n";
}

std::string examples_text(const CommandGuide& guide) {
  if (guide.examples.empty()) return {};
  std::string text = guide.examples.size() == 1 ? "\nExample:\n" : "\nExamples:\n";
  for (const CommandExample& example : guide.examples) {
    text += "  " + example.purpose + ":\n    ";
    std::string line;
    wrap(line, 4, example.line, 8);
    std::size_t at = 0;
    while ((at = line.find('\n', at)) != std::string::npos) {
      line.insert(at, " \\");
      at += 3;
    }
    text += line + "\n";
  }
  return text;
}

std::string command_help(const CLI::App& command, HelpExtent extent) {
  const Options options = option_facts(command);
  const CommandGuide& guide = guide_of(command.get_name());
  std::string text;
  wrap(text, 0, command.get_description(), 0);
  text += "\n\n" + usage_line(command, options);
  for (const OptionFacts& option : options) {
    if (option.positional) text += "\n" + lines_of(option);
  }
  const bool few = extent == HelpExtent::kMostUsed && !guide.most_used.empty();
  text += few ? most_used_text(options, guide.most_used) : groups_text(options);
  if (extent == HelpExtent::kAll && command.get_parent() != nullptr) {
    text += groups_text(option_facts(*command.get_parent()));
  }
  text += examples_text(guide);
  if (few) text += "\nmesamis " + command.get_name() + " --help-all shows all options.\n";
  return text;
}

std::string program_help(const CLI::App& program) {
  constexpr std::size_t kNames = 18;
  std::string text = program.get_description() +
                     "\n\nUsage: mesamis COMMAND [OPTION]... [ARGUMENT]...\n\nCommands:\n";
  for (const CLI::App* command : shown_commands(program)) {
    std::string line = "  " + command->get_name();
    line.resize(std::max(line.size() + 2, kNames), ' ');
    wrap(line, line.size(), command->get_description(), kNames);
    text += line + "\n";
  }
  return text + groups_text(option_facts(program)) +
         "\nmesamis COMMAND --help shows the options of a command used most, and examples.\n";
}

class Help : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode mode) const override {
    return help_text(*app,
                     mode == CLI::AppFormatMode::All ? HelpExtent::kAll : HelpExtent::kMostUsed);
  }
};

}  // namespace

std::string help_text(const CLI::App& app, HelpExtent extent) {
  return app.get_parent() == nullptr ? program_help(app) : command_help(app, extent);
}

void set_up_help(CLI::App& program) {
  program.formatter(std::make_shared<Help>());
  program.set_help_flag("-h,--help", "Show the options used most, and examples");
  program.set_help_all_flag("--help-all", "Show all options");
}

}  // namespace mesamis
