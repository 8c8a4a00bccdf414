// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/child_process.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
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
  EXPECT_EQ(run.end, ChildEnd::kExited);
  const ChildRun killed = run_lines(folder, "kill -9 $$");
  EXPECT_EQ(killed.status, -SIGKILL);
  EXPECT_EQ(killed.end, ChildEnd::kSignal);
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

/// What a caller could notice if it were changed.
struct CallerState {
  std::string folder = std::filesystem::current_path();
  std::string environment;
  sigset_t mask;
  std::vector<struct sigaction> actions{NSIG};
  int descriptors = 0;

  CallerState() {
    for (char** entry = environ; *entry; ++entry) environment += std::string(*entry) + '\n';
    pthread_sigmask(SIG_SETMASK, nullptr, &mask);
    for (int number = 1; number < NSIG; ++number) {
      sigaction(number, nullptr, &actions[static_cast<std::size_t>(number)]);
    }
    for (int file = 0; file < 256; ++file) descriptors += fcntl(file, F_GETFD) >= 0;
  }
};

TEST(ChildProcess, LeavesTheCallerAsItWas) {
  const TempFolder folder;
  const CallerState before;
  run_lines(folder, "cd /; exec 2>&-; exit 1");
  EXPECT_THROW(run_child({"/bin/sleep", {"60"}, "/"}, [n = 0]() mutable { return ++n > 1; }),
               Cancelled);
  const CallerState after;
  EXPECT_EQ(after.folder, before.folder);
  EXPECT_EQ(after.environment, before.environment);
  EXPECT_EQ(after.descriptors, before.descriptors);
  for (int number = 1; number < NSIG; ++number) {
    EXPECT_EQ(sigismember(&after.mask, number), sigismember(&before.mask, number)) << number;
    const auto n = static_cast<std::size_t>(number);
    EXPECT_EQ(after.actions[n].sa_handler, before.actions[n].sa_handler) << number;
  }
}

/// Handlers and blocked signals of the caller are not those of the child.
TEST(ChildProcess, GetsSignalsUnblockedAndByDefault) {
  sigset_t terminate, before;
  sigemptyset(&terminate);
  sigaddset(&terminate, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &terminate, &before);
  const auto handler = signal(SIGTERM, [](int) {});
  const TempFolder folder;
  const ChildRun run = run_lines(folder, "kill -TERM $$; echo alive");
  signal(SIGTERM, handler);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_EQ(run.end, ChildEnd::kSignal);
  EXPECT_EQ(run.status, -SIGTERM);
  EXPECT_EQ(run.output, "");
}

TEST(ChildProcess, IsKilledAfterTheTimeout) {
  const TempFolder folder;
  write_script(folder / "program", "echo started; exec sleep 60");
  ChildRequest request{folder / "program", {}, folder.path()};
  request.timeout_seconds = 0.3;
  const ChildRun run = run_child(request);
  EXPECT_EQ(run.end, ChildEnd::kTimeout);
  EXPECT_EQ(run.status, -SIGKILL);
  EXPECT_EQ(run.output, "started\n");
  EXPECT_GE(run.seconds, 0.3);
  EXPECT_LT(run.seconds, 30);
}

TEST(ChildProcess, IsKilledWhenItWritesTooMuch) {
  const TempFolder folder;
  write_script(folder / "program", "while :; do echo line; done");
  ChildRequest request{folder / "program", {}, folder.path()};
  request.output_limit = 1001;
  const ChildRun run = run_child(request);
  EXPECT_EQ(run.end, ChildEnd::kOutputLimit);
  EXPECT_EQ(run.output.size(), 1001u);
  write_script(folder / "program", "printf 1234");
  for (const std::size_t limit : {std::size_t{4}, std::size_t{3}}) {
    request.output_limit = limit;
    const ChildRun exact = run_child(request);
    EXPECT_EQ(exact.end, limit == 4 ? ChildEnd::kExited : ChildEnd::kOutputLimit);
    EXPECT_EQ(exact.output, std::string("1234").substr(0, limit));
  }
}

TEST(ChildProcess, IsKilledWhenTheCallerStopsOrThrows) {
  const TempFolder folder;
  write_script(folder / "program", "echo $$ > number; exec sleep 60");
  const ChildRequest request{folder / "program", {}, folder.path()};
  const auto started = [&folder] { return !read_bytes(folder / "number").empty(); };
  EXPECT_THROW(run_child(request, started), Cancelled);
  EXPECT_NE(kill(std::stoi(read_bytes(folder / "number")), 0), 0) << "it is gone";
  std::filesystem::remove(folder / "number");
  const auto fail = [&started]() -> bool {
    return started() ? throw std::runtime_error("no") : false;
  };
  EXPECT_THROW(run_child(request, fail), std::runtime_error);
  EXPECT_NE(kill(std::stoi(read_bytes(folder / "number")), 0), 0) << "it is gone";
}

TEST(ChildProcess, IsNotStartedWhenTheCallerHasStopped) {
  const TempFolder folder;
  write_script(folder / "program", "touch started");
  EXPECT_THROW(run_child({folder / "program", {}, folder.path()}, [] { return true; }), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder / "started"));
}

TEST(ChildProcess, EndsWithTheProgramAndNotWithWhatItLeavesRunning) {
  const TempFolder folder;
  const ChildRun run = run_lines(folder, "sleep 5 & echo done");
  EXPECT_EQ(run.output, "done\n");
  EXPECT_LT(run.seconds, 4);
}

}  // namespace
}  // namespace mesamis
