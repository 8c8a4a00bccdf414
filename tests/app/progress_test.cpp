// SPDX-License-Identifier: Apache-2.0
// Progress as people and programs see it.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "support/run_program.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kWipe = "\r\x1b[K";

struct TerminalRun {
  int status = -1;
  std::string seen;  ///< on the terminal: stderr
};

/// Runs mesamis with stderr on a terminal of so many columns.
TerminalRun run_on_terminal(const TempFolder& folder, std::vector<std::string> arguments,
                            unsigned short columns) {
  arguments.insert(arguments.begin(), MESAMIS_PROGRAM);
  std::vector<char*> pointers;
  for (std::string& word : arguments) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string out = folder / ".out";
  winsize size{24, columns, 0, 0};
  int ours = -1, theirs = -1;
  if (openpty(&ours, &theirs, nullptr, nullptr, &size) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(theirs, STDERR_FILENO);
    close(ours);
    execv(pointers[0], pointers.data());
    _exit(126);
  }
  close(theirs);
  TerminalRun run;
  char bytes[4096];
  for (ssize_t n = 0; (n = read(ours, bytes, sizeof bytes)) > 0;) {
    run.seen.append(bytes, static_cast<std::size_t>(n));
  }
  close(ours);
  int status = 0;
  waitpid(child, &status, 0);
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

/// What stood on the line, one after another.
std::vector<std::string> drawn(const std::string& seen) {
  std::vector<std::string> lines;
  std::size_t at = 0;
  while ((at = seen.find(kWipe, at)) != std::string::npos) {
    at += std::string(kWipe).size();
    lines.push_back(seen.substr(at, seen.find(kWipe, at) - at));
  }
  return lines;
}

class ProgressTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(
        run_program(folder_, {"phantom", "sphere", "--size", "16,16,16", "-o", scan()}).status, 0);
  }
  std::string scan() const { return folder_ / "scan.nrrd"; }
  std::vector<std::string> segment(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"segment",       scan(), "-o",         folder_ / "a.stl",
                                   "--adaptations", "2",    "--max-tets", "3000"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  TempFolder folder_;
};

TEST_F(ProgressTest, IsABarOnATerminalThatIsWipedAtTheEnd) {
  const TerminalRun run = run_on_terminal(folder_, segment(), 80);
  EXPECT_THAT(run.status, testing::AnyOf(0, 4));
  const auto lines = drawn(run.seen);
  ASSERT_GT(lines.size(), 2u);
  EXPECT_THAT(lines[0], testing::MatchesRegex("reading \\[[#-]+\\] +[0-9]+ %"));
  for (const std::string& line : lines) {
    const bool is_bar = line.find('[') != std::string::npos;
    EXPECT_TRUE(!is_bar || line.size() <= 80) << line;
  }
  EXPECT_THAT(run.seen, HasSubstr("adaptation 1 of 2"));
  const std::string& last = lines.back();  // nothing, or the line of an error
  EXPECT_THAT(last, Not(HasSubstr("%")));
}

TEST_F(ProgressTest, IsOneBarOfTheWholeRunThatNeverGoesBack) {
  const TerminalRun run = run_on_terminal(folder_, segment(), 80);
  static const std::regex percent("([0-9]+) %");
  int before = 0, bars = 0;
  for (const std::string& line : drawn(run.seen)) {
    std::smatch found;
    if (line.starts_with("mesamis:") || !std::regex_search(line, found, percent)) continue;
    const int now = std::stoi(found[1]);
    EXPECT_GE(now, before) << line;
    before = now;
    ++bars;
  }
  EXPECT_GT(bars, 4);
  EXPECT_GE(before, 70) << "the last stage";
}

TEST_F(ProgressTest, EndsWithFiveLinesOfWhatCameOut) {
  const TerminalRun run = run_on_terminal(folder_, segment(), 80);
  const std::size_t first = run.seen.find("mesamis: object   all that is bright, 1 part, closed");
  ASSERT_NE(first, std::string::npos) << run.seen;
  const std::string lines = run.seen.substr(first);
  EXPECT_THAT(lines, HasSubstr("mesamis: size     "));
  EXPECT_THAT(lines, HasSubstr(" triangles, level "));
  EXPECT_THAT(lines, HasSubstr(" mm expected in the mean"));
  EXPECT_THAT(lines, HasSubstr(": a.stl"));
}

TEST_F(ProgressTest, FitsANarrowTerminal) {
  const TerminalRun run = run_on_terminal(folder_, segment(), 48);
  const auto lines = drawn(run.seen);
  ASSERT_GT(lines.size(), 2u);
  for (const std::string& line : lines) {
    EXPECT_TRUE(line.find('[') == std::string::npos || line.size() < 48) << line;
  }
}

TEST_F(ProgressTest, IsNotDrawnWhereNobodyWantsIt) {
  EXPECT_EQ(run_on_terminal(folder_, segment({"--preview", "--quiet"}), 80).seen, "");
  const ProgramRun run = run_program(folder_, segment({"--preview"}));
  EXPECT_THAT(run.err, Not(HasSubstr("\x1b")));
  EXPECT_THAT(run.err, Not(HasSubstr("\r")));
}

TEST_F(ProgressTest, IsALineOfJsonEachForPrograms) {
  for (const bool terminal : {false, true}) {
    const auto words = segment({"--log-json"});
    std::string text =
        terminal ? run_on_terminal(folder_, words, 80).seen : run_program(folder_, words).err;
    text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());  // the terminal's own
    std::istringstream lines(text);
    std::vector<std::string> stages;
    double done = 0;
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::json::parse(line);
      EXPECT_TRUE(json["time"].is_string());
      if (json["level"] != "progress") {
        EXPECT_TRUE(json["message"].is_string());
        continue;
      }
      EXPECT_GE(json["fraction"], 0);
      EXPECT_LE(json["fraction"], 1);
      EXPECT_GE(json["done"], done);
      EXPECT_LE(json["done"], 1);
      done = json["done"];
      if (stages.empty() || stages.back() != json["stage"]) stages.push_back(json["stage"]);
    }
    EXPECT_THAT(stages,
                testing::IsSupersetOf({std::string("preparation"),
                                       std::string("final minimisation"), std::string("surface")}));
  }
}

TEST_F(ProgressTest, WarningsAndErrorsHaveTheirLevels) {
  const ProgramRun run = run_program(folder_, {"--log-json", "info", folder_ / "none.nrrd"});
  EXPECT_EQ(nlohmann::json::parse(run.err)["level"], "error");
}

}  // namespace
}  // namespace mesamis
