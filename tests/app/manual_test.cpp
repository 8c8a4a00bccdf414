// SPDX-License-Identifier: Apache-2.0
// mesamis manual: pages that man and mandoc accept, completion that shells run, nothing forgotten.
#include <gmock/gmock.h>

#include <filesystem>
#include <regex>
#include <set>

#include "commands.h"
#include "support/external_program.h"
#include "support/run_program.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ManualTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(folder / "man");
    const ProgramRun run =
        run_program(folder, {"manual", "--man", folder / "man", "--bash", folder / "bash", "--zsh",
                             folder / "_mesamis", "--date", "2026-11-24"});
    ASSERT_EQ(run.status, kExitDone) << run.err;
  }

  std::string page(const std::string& name) const { return read_bytes(folder / ("man/" + name)); }

  /// What bash offers for the last of the words, with single blanks between.
  std::string completed(const std::string& words) const {
    write_bytes(folder / "ask", "source ./bash\nCOMP_WORDS=(" + words +
                                    ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_mesamis\n"
                                    "echo \"${COMPREPLY[*]}\"\n");
    EXPECT_EQ(run_in(folder / ".", "bash -eu ask"), 0) << read_bytes(folder / "log");
    return read_bytes(folder / "log");
  }

  TempFolder folder;
};

/// The long options in a text, without those of the form --no-x in "Excludes".
std::set<std::string> long_options(const std::string& text) {
  static const std::regex option("--[a-z][a-z0-9-]+");
  return {std::sregex_token_iterator(text.begin(), text.end(), option),
          std::sregex_token_iterator()};
}

std::string without_backslashes(std::string text) {
  std::erase(text, '\\');
  return text;
}

TEST_F(ManualTest, HasAPageOfEachCommandWithAllItsOptions) {
  const ProgramRun help = run_program(folder, {"--help"});
  static const std::regex command("\n  ([a-z-]+) +[A-Z]");
  const std::string commands = help.out.substr(
      help.out.find("Commands:"), help.out.find("\nOptions:") - help.out.find("Commands:"));
  std::size_t seen = 0;
  for (std::sregex_iterator at(commands.begin(), commands.end(), command), end; at != end; ++at) {
    const std::string name = (*at)[1];
    const std::string text = without_backslashes(page("mesamis-" + name + ".1"));
    const std::string all =
        run_program(folder, {name, "--help-all"}).out;  // the program's own last
    for (const std::string& option : long_options(all.substr(0, all.find("  --version")))) {
      EXPECT_THAT(text, HasSubstr(option)) << name;
      EXPECT_THAT(read_bytes(folder / "_mesamis"), HasSubstr(option)) << name;
      EXPECT_THAT(read_bytes(folder / "bash"), HasSubstr(option)) << name;
    }
    EXPECT_THAT(page("mesamis.1"), HasSubstr(name == "slice" ? "slice" : "\\fB"));
    ++seen;
  }
  EXPECT_GE(seen, 12u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "man"), {}),
            static_cast<std::ptrdiff_t>(seen + 1));
}

TEST_F(ManualTest, TellsTheSettingsAndTheExitStatus) {
  const std::string settings = without_backslashes(page("mesamis-settings.1"));
  EXPECT_THAT(settings, HasSubstr("max_tets"));
  EXPECT_THAT(settings, HasSubstr("Range: "));
  EXPECT_THAT(page("mesamis-segment.1"), HasSubstr(".SH EXIT STATUS"));
  EXPECT_THAT(page("mesamis-segment.1"), HasSubstr("2026-11-24"));
  EXPECT_THAT(page("mesamis-segment.1"), HasSubstr(".SH EXAMPLES"));
}

TEST_F(ManualTest, IsTheSameEveryTime) {
  fs::create_directory(folder / "again");
  const ProgramRun run =
      run_program(folder, {"manual", "--man", folder / "again", "--date", "2026-11-24"});
  ASSERT_EQ(run.status, kExitDone);
  for (const auto& entry : fs::directory_iterator(folder / "again")) {
    EXPECT_EQ(read_bytes(entry.path()), page(entry.path().filename().string()));
  }
}

TEST_F(ManualTest, IsAcceptedByMandoc) {
  MESAMIS_REQUIRE_PROGRAM("mandoc");
  EXPECT_EQ(run_in(folder / "man", "mandoc -T lint *.1"), 0) << read_bytes(folder / "man/log");
}

TEST_F(ManualTest, IsAcceptedByGroff) {
  MESAMIS_REQUIRE_PROGRAM("groff");
  ASSERT_EQ(run_in(folder / "man", "(groff -ww -K utf8 -man -Tutf8 -Z *.1 2>&1 >/dev/null)"), 0);
  EXPECT_EQ(read_bytes(folder / "man/log"), "");
}

TEST_F(ManualTest, BashCompletesCommandsOptionsAndWords) {
  MESAMIS_REQUIRE_PROGRAM("bash");
  EXPECT_EQ(completed("mesamis ph"), "phantom\n");
  EXPECT_EQ(completed("mesamis --quiet pic"), "picture\n");
  EXPECT_EQ(completed("mesamis segment --max-t"), "--max-tets\n");
  EXPECT_EQ(completed("mesamis segment --surface ''"), "solid band\n");
  EXPECT_EQ(completed("mesamis segment --until = ei"), "either\n");
  EXPECT_EQ(completed("mesamis phantom fem"), "femur\n");
  EXPECT_EQ(completed("mesamis info --thr"), "--threads\n");
  EXPECT_EQ(completed("mesamis --threads ''"), "\n");
}

TEST_F(ManualTest, BashCompletesFilesThatAnOptionTakes) {
  MESAMIS_REQUIRE_PROGRAM("bash");
  for (const char* name : {"bone.stl", "bone x.3mf", "bone.txt"}) write_bytes(folder / name, "");
  EXPECT_EQ(completed("mesamis segment scan.nii -o bone."), "bone.stl\n");
  EXPECT_EQ(completed("mesamis segment scan.nii -o 'bone x'"), "bone x.3mf\n");
  EXPECT_EQ(completed("mesamis segment bone.t"), "bone.txt\n");
  EXPECT_EQ(completed("mesamis segment nothing"), "\n");
}

TEST_F(ManualTest, ZshReadsTheCompletion) {
  MESAMIS_REQUIRE_PROGRAM("zsh");
  EXPECT_EQ(run_in(folder / ".", "zsh -n _mesamis"), 0) << read_bytes(folder / "log");
}

TEST(Manual, RefusesWhatItCannotDo) {
  const TempFolder folder;
  EXPECT_FAILS(run_program(folder, {"manual"}), kExitUsage, "expected --man, --bash or --zsh");
  EXPECT_FAILS(run_program(folder, {"manual", "--man", folder / "none"}), kExitInput,
               "expected a folder that exists");
  EXPECT_FAILS(run_program(folder, {"manual", "--bash", folder / "b", "--date", "today"}),
               kExitUsage, "expected YYYY-MM-DD, found 'today'");
  EXPECT_FALSE(fs::exists(folder / "b"));
}

}  // namespace
}  // namespace mesamis
