// SPDX-License-Identifier: Apache-2.0
// The command line itself: help, version, usage, the log.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Arguments, VersionAndHelpAreResults) {
  const TempFolder folder;
  const ProgramRun version = run_program(folder, {"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, testing::MatchesRegex("mesamis [0-9.]+ \\(commit .+\\)\n"));
  EXPECT_EQ(version.err, "");
  const ProgramRun help = run_program(folder, {"--help"});
  EXPECT_EQ(help.status, 0);
  for (const auto* command :
       {"segment", "remesh", "compare", "study", "picture", "info", "slice"}) {
    EXPECT_THAT(help.out, HasSubstr(command));
    const ProgramRun one = run_program(folder, {command, "--help"});
    EXPECT_EQ(one.status, 0);
    EXPECT_THAT(one.out, HasSubstr("Usage"));
  }
}

TEST(Arguments, UsageErrorsAreOneLineAndStatusTwo) {
  const TempFolder folder;
  EXPECT_FAILS(run_program(folder, {}), 2, "command is required");
  EXPECT_FAILS(run_program(folder, {"sgement"}), 2, "sgement");
  EXPECT_FAILS(run_program(folder, {"info"}), 2, "input");
  EXPECT_FAILS(run_program(folder, {"info", "a", "b"}), 2, "b");
  EXPECT_FAILS(run_program(folder, {"info", "a", "--frobnicate"}), 2, "--frobnicate");
  EXPECT_FAILS(run_program(folder, {"info", "a", "--threads", "none"}), 2, "--threads");
  EXPECT_FAILS(run_program(folder, {"remesh", "a.mesh", "-o", "b.mesh"}), 2, "--metric");
}

TEST(Arguments, ErrorsOfAnOptionNameItOnce) {
  const TempFolder folder;
  for (const char* option : {"--box", "--tissue", "--padding", "--crop", "--window"}) {
    const ProgramRun run =
        run_program(folder, {"segment", "a.nrrd", "-o", "a.stl", option, "nonsense"});
    EXPECT_EQ(run.status, 2) << option;
    EXPECT_THAT(run.err, testing::HasSubstr(std::string(option) + ": expected ")) << run.err;
  }
  const ProgramRun set =
      run_program(folder, {"segment", "a.nrrd", "--body", "a.inp", "--set", "x"});
  EXPECT_THAT(set.err, testing::HasSubstr("--set: expected ")) << set.err;
}

TEST(Arguments, ARepeatedOptionIsExpectedOnce) {
  const TempFolder folder;
  EXPECT_FAILS(run_program(folder, {"segment", "a.nrrd", "--margin", "1", "--margin", "2"}), 2,
               "--margin: expected once, found 2 times (");
}

TEST(Arguments, CommonOptionsMayStandBeforeOrAfterTheCommand) {
  const TempFolder folder;
  const std::string none = folder / "none.nii";
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"--log-json", "--threads", "1", "info", none}, {"info", none, "--log-json"}}) {
    const ProgramRun run = run_program(folder, arguments);
    EXPECT_EQ(run.status, 3);
    const auto line = nlohmann::json::parse(run.err);
    EXPECT_EQ(line["level"], "error");
    EXPECT_THAT(line["message"], HasSubstr("none.nii"));
  }
}

TEST(Arguments, FailuresStayOnOneLineWhateverTheNames) {
  const TempFolder folder;
  EXPECT_FAILS(run_program(folder, {"info", "two\nlines\x1b[31m.nii"}), 3, "lines");
  EXPECT_FAILS(run_program(folder, {"--quiet", "info", "missing.nii"}), 3, "missing.nii");
  EXPECT_FAILS(run_program(folder, {"info", "no\xff\xc2\x9b.nii"}), 3, "no??.nii");
  EXPECT_FAILS(run_program(folder, {"info", "a.nii", "--\xe2\x82"}), 2, "--??");
}

TEST(Arguments, ALineOfErrorHasAtMost500Characters) {
  const TempFolder folder;
  const std::string name(100'000, 'x');
  write_bytes(folder / "settings.json", "{\"" + name + "\": 1}");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", name},
        {"segment", "scan.nii", "-o", "a." + name},
        {"segment", "scan.nii", "--report", folder / "r.json", "--settings",
         folder / "settings.json"},
        {"segment", "scan.nii", "--preset", name}}) {
    const ProgramRun run = run_program(folder, arguments);
    EXPECT_TRUE(run.status == 2 || run.status == 3) << run.status;
    EXPECT_EQ(run.error_lines(), 1u);
    EXPECT_LE(run.err.size(), 501u);
  }
}

TEST(Arguments, LinksInACircleAndClosedFoldersAreNoBugsOfOurs) {
  const TempFolder folder;
  std::filesystem::create_symlink("circle", folder / "circle");
  const std::string circle = folder / "circle";
  EXPECT_EQ(run_program(folder, {"info", circle}).status, 3);
  EXPECT_EQ(run_program(folder, {"info", circle + "/a.nrrd"}).status, 3);
  EXPECT_EQ(run_program(folder, {"segment", "none.nrrd", "-o", circle + "/a.stl"}).status, 3);
  EXPECT_EQ(run_program(folder, {"picture", circle, "-o", folder / "a.png"}).status, 3);
  EXPECT_EQ(run_program(folder, {"study", "none.nrrd", "--reference", "none.stl", "-o", circle,
                                 "--subsample", "1"})
                .status,
            3);
}

}  // namespace
}  // namespace mesamis
