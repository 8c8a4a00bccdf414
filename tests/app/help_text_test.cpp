// SPDX-License-Identifier: Apache-2.0
// Help: what is shown first, what is shown at all, and examples that hold.
#include "help_text.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <regex>
#include <sstream>

#include "command_guide.h"
#include "command_line.h"
#include "option_facts.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The parser of the program.
struct Program {
  CLI::App app{"program"};
  CommonOptions common;
  Action action;

  Program() { add_commands(app, common, action); }
  CLI::App& command(const std::string& name) { return *app.get_subcommand(name); }
};

/// Lines that begin with an option.
std::size_t options_in(const std::string& help) {
  std::istringstream lines(help);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) count += line.starts_with("  -");
  return count;
}

/// The words of a line for a shell; only single quotes are known.
std::vector<std::string> shell_words(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; stream >> word;) {
    std::erase(word, '\'');
    words.push_back(word);
  }
  return words;
}

TEST(HelpText, OfSegmentHasFifteenOptionsAndFourExamples) {
  Program program;
  const std::string help = help_text(program.command("segment"), HelpExtent::kMostUsed);
  EXPECT_EQ(options_in(help), 15u);
  const CommandGuide& guide = guide_of("segment");
  EXPECT_EQ(guide.examples.size(), 4u);
  for (const CommandExample& example : guide.examples) {
    EXPECT_THAT(help, HasSubstr(example.purpose));
  }
  EXPECT_THAT(help, HasSubstr("--help-all shows all options"));
  EXPECT_THAT(help, Not(HasSubstr("--solver-tolerance")));
}

TEST(HelpText, OfAllHasEveryOptionUnderAHeading) {
  Program program;
  for (const CLI::App* command : shown_commands(program.app)) {
    const std::string help = help_text(*command, HelpExtent::kAll);
    for (const CLI::App* owner : {command, static_cast<const CLI::App*>(&program.app)}) {
      for (const OptionFacts& option : option_facts(*owner)) {
        const std::string& name = option.names.back();
        EXPECT_THAT(help, HasSubstr(option.positional ? in_capitals(name) : name))
            << command->get_name();
      }
    }
    EXPECT_THAT(help, HasSubstr("\nOptions of every command:\n"));
  }
  const std::string segment = help_text(program.command("segment"), HelpExtent::kAll);
  for (const char* group : {"Files written", "Which object", "Scan", "Finite elements", "Run",
                            "Image", "Functional", "Mesh", "Surface"}) {
    EXPECT_THAT(segment, HasSubstr(std::string("\n") + group + ":\n"));
  }
}

/// A value that is called FILE is one: what is said of it names a file or folder, or its endings.
TEST(HelpText, CallsFilesAloneFiles) {
  static const std::regex file(
      R"((Folder|File|Surface|Label map|Scan|Volume|Mesh|Page|Report|Histogram|Settings|Metric|)"
      R"(Names and colours|Completion|Body|Figures of the run|volume of probabilities|surface|)"
      R"(mesh|cells with v|result as voxels|What was found|G-code|Picture))");
  Program program;
  for (const CLI::App* command : shown_commands(program.app)) {
    for (const OptionFacts& option : option_facts(*command)) {
      if (option.positional) continue;
      const std::string name = command->get_name() + " " + option.names.back();
      EXPECT_EQ(option.value.find("TEXT"), std::string::npos) << name << ": of what form?";
      if (!option.file) continue;
      EXPECT_TRUE(std::regex_search(option.help, file)) << name << ": " << option.help;
    }
  }
  const std::string slice = help_text(program.command("slice"), HelpExtent::kAll);
  EXPECT_THAT(slice, HasSubstr("--layer X "));
  EXPECT_THAT(help_text(program.command("compare"), HelpExtent::kAll), HasSubstr("--box RANGES"));
}

TEST(HelpText, FitsATerminal) {
  Program program;
  std::vector<std::string> texts{help_text(program.app, HelpExtent::kMostUsed)};
  for (const CLI::App* command : shown_commands(program.app)) {
    texts.push_back(help_text(*command, HelpExtent::kMostUsed));
    texts.push_back(help_text(*command, HelpExtent::kAll));
  }
  for (const std::string& text : texts) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const bool one_word = line.find(' ', line.find_first_not_of(' ')) == std::string::npos;
      EXPECT_TRUE(line.size() <= 80 || one_word) << line;
    }
  }
}

/// Files are missing, so that each is refused; the command line itself is not.
TEST(CommandGuide, ItsExamplesAreLinesThatTheParserTakes) {
  Program program;
  for (const CLI::App* command : shown_commands(program.app)) {
    const CommandGuide& guide = guide_of(command->get_name());
    EXPECT_TRUE(!guide.examples.empty() || command->get_name() == "slicer-segment")
        << command->get_name();
    for (const CommandExample& example : guide.examples) {
      Program parser;
      const std::vector<std::string> words = shell_words(example.line);
      std::vector<const char*> pointers;
      for (const std::string& word : words) pointers.push_back(word.c_str());
      EXPECT_NO_THROW(parser.app.parse(static_cast<int>(pointers.size()), pointers.data()))
          << example.line;
    }
    const std::vector<OptionFacts> options = option_facts(*command);
    for (const std::string& name : guide.most_used) {
      EXPECT_TRUE(std::any_of(options.begin(), options.end(), [&](const OptionFacts& option) {
        return std::find(option.names.begin(), option.names.end(), name) != option.names.end();
      })) << name;
    }
  }
}

TEST(CommandGuide, ExamplesOfSegmentAskForWhatCanBeMade) {
  const TempFolder folder;
  for (const CommandExample& example : guide_of("segment").examples) {
    std::vector<std::string> words = shell_words(example.line);
    words.erase(words.begin());
    const ProgramRun run = run_program(folder, words);
    EXPECT_EQ(run.status, kExitInput) << example.line << ": " << run.err;
  }
}

TEST(Ranges, AreToldInWords) {
  const TempFolder folder;
  EXPECT_FAILS(run_program(folder, {"segment", "a.nii", "--time-limit", "0"}), 2,
               "--time-limit: expected a number above 0, found '0'");
  EXPECT_FAILS(run_program(folder, {"segment", "a.nii", "--material-gap", "-1"}), 2,
               "expected a number of 0 or more, found '-1'");
  EXPECT_FAILS(run_program(folder, {"info", "a.nii", "--threads", "0"}), 2,
               "expected a number from 1 to 1024, found '0'");
  EXPECT_FAILS(run_program(folder, {"segment", "a.nii", "--memory", "much"}), 2,
               "expected a number above 0, found 'much'");
}

TEST(DidYouMean, NamesTheNearestOptionOrCommand) {
  const TempFolder folder;
  EXPECT_FAILS(run_program(folder, {"segment", "a.nii", "--tolerence", "0.1"}), 2,
               "no option '--tolerence'; did you mean --tolerance?");
  EXPECT_FAILS(run_program(folder, {"segment", "a.nii", "--quite"}), 2, "did you mean --quiet?");
  EXPECT_FAILS(run_program(folder, {"segmnt", "a.nii"}), 2,
               "no command 'segmnt'; did you mean segment?");
  EXPECT_FAILS(run_program(folder, {"segment", "a.nii", "--frobnicate=1"}), 2,
               "no option '--frobnicate' (");
  write_bytes(folder / "s.json", "{\"tolerence\": 1}");
  EXPECT_FAILS(run_program(folder, {"segment", "a.nii", "-o", folder / "a.stl", "--settings",
                                    folder / "s.json"}),
               3, "did you mean tolerance?");
}

}  // namespace
}  // namespace mesamis
