// SPDX-License-Identifier: Apache-2.0
#include "virtual_display.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <vector>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/printing/child_process.h"

namespace mesamis {
namespace {

constexpr int kStartMilliseconds = 30'000;
constexpr const char* kAuthority = "XAUTHORITY";  // where Xlib finds the cookie
constexpr const char* kHint = " (install the package xvfb, or set DISPLAY)";

/// The command line, made before fork(): after it nothing may be allocated.
struct Command {
  std::vector<std::string> words;
  std::vector<char*> pointers;
};

/// One entry of the file format of libXau: any display, the cookie that opens it.
std::string authority_bytes() {
  const std::string method = "MIT-MAGIC-COOKIE-1";
  std::string cookie(16, '\0');
  if (getentropy(cookie.data(), cookie.size()) != 0) throw InputError("Xvfb: no random numbers");
  const auto counted = [](const std::string& text) {
    return std::string{'\0', static_cast<char>(text.size())} + text;
  };
  return "\xff\xff" + counted("") + counted("") + counted(method) + counted(cookie);
}

/// @param ready      the descriptor that the server writes its display number to.
/// @param authority  file of the cookie that the server asks for.
Command server_command(int ready, const std::string& authority) {
  const std::string program = find_program("Xvfb");
  if (program.empty()) {
    throw InputError(std::string("no X display to draw on, and Xvfb is not installed") + kHint);
  }
  Command command{{program, "-displayfd", std::to_string(ready), "-screen", "0", "640x480x24",
                   "-nolisten", "tcp", "+extension", "GLX", "-noreset", "-auth", authority},
                  {}};
  for (std::string& word : command.words) command.pointers.push_back(word.data());
  command.pointers.push_back(nullptr);
  return command;
}

/// In the child: only calls that are safe in a signal handler.
[[noreturn]] void become_server(const Command& command, int ready, pid_t parent) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
  if (getppid() != parent) _exit(1);  // it ended before it could be watched
  const int nothing = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, stream);
  fcntl(ready, F_SETFD, 0);  // the only descriptor that survives exec
  execv(command.pointers[0], command.pointers.data());
  _exit(127);
}

/// Reads the display number up to its newline; empty if the server ended or took too long.
std::string read_number(int ready) {
  std::string number;
  pollfd request{ready, POLLIN, 0};
  char digit = 0;
  while (poll(&request, 1, kStartMilliseconds) == 1 && read(ready, &digit, 1) == 1) {
    if (digit == '\n') return number;
    number += digit;
  }
  return {};
}

void end_server(pid_t server) {
  kill(server, SIGTERM);
  while (waitpid(server, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

VirtualDisplay::VirtualDisplay() : folder_("display") {
  const std::string authority = folder_.path() / "authority";
  write_file(authority, authority_bytes());
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) throw InputError("Xvfb: no pipe can be made");
  const auto [reading, writing] = pipe_ends;
  try {
    const Command command = server_command(writing, authority);
    const pid_t parent = getpid();
    server_ = fork();
    if (server_ == 0) become_server(command, writing, parent);
  } catch (...) {
    for (const int end : pipe_ends) close(end);
    throw;
  }
  close(writing);
  const std::string number = server_ > 0 ? read_number(reading) : "";
  close(reading);
  if (number.empty()) {
    if (server_ > 0) end_server(server_);
    throw InputError(std::string("no X display to draw on, and Xvfb did not start") + kHint);
  }
  name_ = ":" + number;
  if (const char* before = getenv(kAuthority)) authority_before_ = before;
  setenv(kAuthority, authority.c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  end_server(server_);
  if (authority_before_) {
    setenv(kAuthority, authority_before_->c_str(), 1);
  } else {
    unsetenv(kAuthority);
  }
}

SilentStderr::SilentStderr() {
  std::fflush(stderr);
  const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nothing < 0) return;
  saved_ = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (saved_ >= 0) dup2(nothing, STDERR_FILENO);
  close(nothing);
}

SilentStderr::~SilentStderr() {
  if (saved_ < 0) return;
  std::fflush(stderr);
  dup2(saved_, STDERR_FILENO);
  close(saved_);
}

}  // namespace mesamis
