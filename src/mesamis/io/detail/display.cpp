// SPDX-License-Identifier: Apache-2.0
#include "mesamis/io/detail/display.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <X11/Xlib.h>

#include "mesamis/base/error.h"

namespace mesamis::detail {
namespace {

constexpr int kStartMilliseconds = 30000;

struct Server {
  pid_t pid = -1;
  int number_from = -1;  // the server writes its display number here once it is ready
};

/// Xlib's display if it can be opened and has GLX, without which VTK ends the process.
::Display* open_display(const char* name) {
  ::Display* display = XOpenDisplay(name);
  if (display == nullptr) return nullptr;
  int opcode = 0, event = 0, error = 0;
  if (XQueryExtension(display, "GLX", &opcode, &event, &error)) return display;
  XCloseDisplay(display);
  return nullptr;
}

/// The child's side of start_server, after fork: only calls that are safe there.
[[noreturn]] void become_server(int number_to, const char* number_to_text) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) dup2(nowhere, stream);
  fcntl(number_to, F_SETFD, 0);  // the only descriptor that survives exec
  execlp("Xvfb", "Xvfb", "-displayfd", number_to_text, "-screen", "0", "640x480x24", "-nolisten",
         "tcp", "+extension", "GLX", static_cast<char*>(nullptr));
  _exit(127);
}

Server start_server() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw InputError("picture: no pipe to start Xvfb with");
  const std::string number_to = std::to_string(ends[1]);
  const pid_t pid = fork();
  if (pid == 0) become_server(ends[1], number_to.c_str());
  close(ends[1]);
  if (pid < 0) {
    close(ends[0]);
    throw InputError("picture: no process to start Xvfb in");
  }
  return {pid, ends[0]};
}

/// Reads up to the newline that ends the display number; empty if the server gave up.
std::string display_number(int from) {
  std::string text;
  pollfd ready{from, POLLIN, 0};
  char c = 0;
  while (poll(&ready, 1, kStartMilliseconds) == 1 && read(from, &c, 1) == 1) {
    if (c == '\n') return text;
    text += c;
  }
  return {};
}

void end_server(pid_t pid) {
  kill(pid, SIGTERM);
  waitpid(pid, nullptr, 0);
}

}  // namespace

XDisplay::XDisplay() {
  if ((connection_ = open_display(nullptr)) != nullptr) return;
  const Server server = start_server();
  const std::string number = display_number(server.number_from);
  close(server.number_from);
  if (!number.empty()) connection_ = open_display((":" + number).c_str());
  if (connection_ == nullptr) {
    end_server(server.pid);
    throw InputError(
        "picture: no X display to draw on: DISPLAY names none that works, and Xvfb did not start "
        "(install the package xvfb)");
  }
  server_ = server.pid;
}

XDisplay::~XDisplay() {
  XCloseDisplay(static_cast<::Display*>(connection_));
  if (server_ > 0) end_server(server_);
}

SilentStderr::SilentStderr() {
  std::fflush(stderr);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  before_ = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (before_ >= 0) dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

SilentStderr::~SilentStderr() {
  if (before_ < 0) return;
  std::fflush(stderr);
  dup2(before_, STDERR_FILENO);
  close(before_);
}

}  // namespace mesamis::detail
