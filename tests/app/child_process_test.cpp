// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include <gmock/gmock.h>
#include <signal.h>

#include "interrupt.h"
#include "private_folder.h"
#include "support/script.h"
#include "support/variable.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

ChildRun run_lines(const TempFolder& folder, const std::string& lines,
                   const std::vector<std::string>& arguments = {}) {
  write_script(folder / "program", lines);
  return run_child({folder / "program", arguments, folder.path()});
}

TEST(ChildProcess, GivesStatusOutputAndCost) {
  const TempFolder folder;
  const ChildRun run = run_lines(folder, "echo one; echo two >&2; exit 3");
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.output, "one\ntwo\n");
  EXPECT_GT(run.seconds, 0);
  EXPECT_GE(run.cpu_seconds, 0);
  EXPECT_GT(run.peak_memory_mb, 0.1);
  EXPECT_EQ(run_lines(folder, "kill -9 $$").status, -SIGKILL);
}

TEST(ChildProcess, ArgumentsPassThroughNoShell) {
  const TempFolder folder;
  const ChildRun run =
      run_lines(folder, "for a; do echo \"[$a]\"; done", {"two words", "$HOME", "", "a;b", "*"});
  EXPECT_EQ(run.output, "[two words]\n[$HOME]\n[]\n[a;b]\n[*]\n");
}

TEST(ChildProcess, SeesNothingOfTheUser) {
  const TempFolder folder;
  const Variable display("DISPLAY", ":7"), other("XDG_CONFIG_HOME", "/somewhere");
  const ChildRun run = run_lines(folder, "env; pwd; read nothing || echo no input");
  EXPECT_THAT(run.output, testing::Not(testing::AnyOf(HasSubstr("DISPLAY"), HasSubstr("XDG"))));
  EXPECT_THAT(run.output, HasSubstr("HOME=" + folder.path().string() + "\n"));
  EXPECT_THAT(run.output, HasSubstr("TMPDIR=" + folder.path().string() + "\n"));
  EXPECT_THAT(run.output, HasSubstr("LC_ALL=C\n"));
  EXPECT_THAT(run.output, HasSubstr("\n" + folder.path().string() + "\nno input\n"));
}

TEST(ChildProcess, LongOutputArrivesWhole) {
  const TempFolder folder;
  const ChildRun run = run_lines(folder, "head -c 1000000 /dev/zero | tr '\\0' x");
  EXPECT_EQ(run.output, std::string(1000000, 'x'));
}

TEST(ChildProcess, WhatCannotStartSaysSoByItsStatus) {
  const TempFolder folder;
  EXPECT_EQ(run_child({folder / "none", {}, folder.path()}).status, 127);
  EXPECT_EQ(run_child({"/bin/true", {}, folder / "none"}).status, 127);
  EXPECT_EQ(run_child({"/bin/true", {}, folder.path()}).status, 0);
}

TEST(ChildProcess, ProgramsAreFoundInPath) {
  const TempFolder folder;
  write_script(folder / "b/tool", "");
  write_bytes(folder / "a/tool", "not executable");
  std::filesystem::create_directories(folder / "c/tool");
  const std::string places[] = {folder / "a", folder / "none", folder / "c", folder / "b"};
  {
    const Variable path("PATH", places[0] + "::" + places[1] + ":" + places[2] + ":" + places[3]);
    EXPECT_EQ(find_program("tool"), folder / "b/tool");
    EXPECT_EQ(find_program("toolbox"), "");
  }
  const Variable path("PATH", "");
  EXPECT_EQ(find_program("tool"), "");
}

TEST(PrivateFolder, IsPrivateAndTakenAway) {
  const TempFolder place;
  const Variable temporary("TMPDIR", place.path());
  std::filesystem::path path;
  {
    const PrivateFolder folder("test");
    path = folder.path();
    EXPECT_EQ(path.parent_path(), place.path());
    EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms::owner_all);
    write_bytes(path / "deep/er/file", "x");
    EXPECT_NE(PrivateFolder("test").path(), path);
  }
  EXPECT_EQ(place.file_count(), 0);
}

/// In a process of its own, for the interrupt is noted for good.
TEST(Interrupt, IsNotedWhileHeldAndStopsTheNextChild) {
  auto scenario = [] {
    if (note_interrupt(SIGINT)) _exit(1);  // nobody holds
    {
      const HeldInterrupts held;
      if (!note_interrupt(SIGTERM)) _exit(2);
      try {
        run_child({"/bin/true", {}, "/"});
        _exit(3);
      } catch (const Interrupted&) {
      }
    }
    _exit(noted_interrupt() == SIGTERM ? 0 : 4);
  };
  EXPECT_EXIT(scenario(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace mesamis
