// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "mesamis/rooms.h"

namespace mesamis::detail::printing {

/// A program to be run as a child process. No shell is involved.
struct ChildRequest {
  std::filesystem::path program;       ///< path of the executable, see find_program()
  std::vector<std::string> arguments;  ///< without the program's name
  std::filesystem::path folder;        ///< its working directory, HOME and TMPDIR
  double timeout_seconds = 0;          ///< wall time after which it is killed, s; 0: no limit
  std::size_t output_limit = std::size_t{64} << 20;  ///< bytes of output before it is killed
};

/// How a child process ended.
enum class ChildEnd {
  kExited,       ///< by itself
  kSignal,       ///< by a signal that run_child() did not send
  kTimeout,      ///< killed after ChildRequest::timeout_seconds
  kOutputLimit,  ///< killed because it wrote more than ChildRequest::output_limit
};

/// What a child process left behind.
struct ChildRun {
  ChildEnd end = ChildEnd::kExited;
  int status = 0;             ///< exit status, 0 to 255; minus the signal's number if one ended it
  std::string output;         ///< stdout and stderr in the order of arrival, at most output_limit
  double seconds = 0;         ///< wall time, s
  double cpu_seconds = 0;     ///< processor time of all its threads, s
  double peak_memory_mb = 0;  ///< MB (10^6 bytes); at least what the caller held at its start
};

/// Searches the folders of the environment variable PATH for an executable file.
///
/// @param name  file name, for example "prusa-slicer".
/// @return absolute path of the first match; empty if there is none.
/// @throws std::filesystem::filesystem_error  if PATH names a relative folder and the working
///                                            directory cannot be found.
std::filesystem::path find_program(const std::string& name);

/// Runs a program to its end and collects its output.
///
/// The child gets a fixed environment, so that the result depends on nobody's configuration: PATH
/// and LD_LIBRARY_PATH of the caller, LC_ALL=C, HOME and TMPDIR as requested, nothing else. Its
/// stdin is empty; stdout and stderr go to one pipe. On Linux it is killed if the calling thread
/// ends.
///
/// The caller's environment, working directory, descriptors and signal handlers are not changed.
/// All signals are blocked in the calling thread while fork() runs. SIGCHLD must not be ignored,
/// or else the exit status is lost. Output that the child's own children write after it has ended
/// is not collected.
///
/// @param request  a child that cannot be executed, or whose folder does not exist, has the exit
///                 status 127.
/// @param stop     called about ten times a second, in the calling thread; true kills the child.
///                 Empty: never.
/// @return status, output and cost. The memory for the output is at most request.output_limit
///         and one pipe buffer.
/// @throws InputError  if the system refuses a pipe or a process, or the exit status is lost.
/// @throws Cancelled   if stop returned true. The child has ended by then, also if `stop` throws.
ChildRun run_child(const ChildRequest& request, const std::function<bool()>& stop = {});

}  // namespace mesamis::detail::printing
