// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/temp_folder.h"

namespace mesamis {

/// How a program ended.
struct ProgramRun {
  int status = -1;  ///< exit status; minus the signal's number if one ended it
  std::string out, err;

  std::size_t error_lines() const {
    return static_cast<std::size_t>(std::count(err.begin(), err.end(), '\n'));
  }
};

/// Starts a program, found as a shell finds it, in the folder, with its output going to files
/// there.
inline pid_t start_command(const TempFolder& folder, std::vector<std::string> command) {
  std::vector<char*> pointers;
  for (std::string& word : command) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string out = folder / ".out", err = folder / ".err";
  const pid_t child = fork();
  if (child == 0) {
    constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
    dup2(open(out.c_str(), kFlags, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), kFlags, 0600), STDERR_FILENO);
    if (chdir(std::string(folder / "").c_str()) != 0) _exit(126);
    execvp(pointers[0], pointers.data());
    _exit(126);
  }
  return child;
}

/// Starts mesamis.
inline pid_t start_program(const TempFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), MESAMIS_PROGRAM);
  return start_command(folder, std::move(arguments));
}

inline ProgramRun await_program(const TempFolder& folder, pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_bytes(folder / ".out"),
          read_bytes(folder / ".err")};
}

inline ProgramRun run_command(const TempFolder& folder, std::vector<std::string> command) {
  return await_program(folder, start_command(folder, std::move(command)));
}

/// Runs mesamis as a user runs it.
inline ProgramRun run_program(const TempFolder& folder, std::vector<std::string> arguments) {
  return await_program(folder, start_program(folder, std::move(arguments)));
}

/// A failure as promised: the status, one line on stderr with these words, nothing on stdout.
inline void expect_failure(const ProgramRun& run, int status, const std::string& words,
                           const char* file, int line) {
  const testing::ScopedTrace trace(file, line, "the program");
  EXPECT_EQ(run.status, status);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.error_lines(), 1u);
  EXPECT_THAT(run.err, testing::HasSubstr(words));
}

}  // namespace mesamis

#define EXPECT_FAILS(run, expected_status, words) \
  mesamis::expect_failure(run, expected_status, words, __FILE__, __LINE__)
