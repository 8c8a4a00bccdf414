// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mesamis {

/// Another program to be run, without a shell between.
struct ChildRequest {
  std::filesystem::path program;       ///< where it is, see find_program()
  std::vector<std::string> arguments;  ///< without the program's name
  std::filesystem::path folder;        ///< where it runs; its HOME and TMPDIR, too
};

/// How it ended and what it took.
struct ChildRun {
  int status = 0;             ///< exit status; minus the signal's number if one ended it
  std::string output;         ///< stdout and stderr as they came
  double seconds = 0;         ///< wall time
  double cpu_seconds = 0;     ///< of all its threads
  double peak_memory_mb = 0;  ///< MB (10^6 bytes); at least what mesamis held when it began
};

/// Where a program is that PATH finds; empty if it is nowhere.
std::filesystem::path find_program(const std::string& name);

/// Runs a program to its end. Of the environment it gets PATH and LD_LIBRARY_PATH, the locale C
/// and no display, so that it does the same for everyone; stdin is empty. It is killed when
/// mesamis is interrupted, and does not outlive it.
/// @throws InputError   if the machine refuses another process.
/// @throws Interrupted  see HeldInterrupts.
ChildRun run_child(const ChildRequest& request);

}  // namespace mesamis
