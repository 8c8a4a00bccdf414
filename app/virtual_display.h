// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "mesamis/printing/temporary_folder.h"

namespace mesamis {

/// An X display without a screen: the server Xvfb, found by PATH and started as a child process. It
/// listens to no TCP port, picks a free display number, lets in only who has its cookie, and ends
/// with this object or with the thread that made it, also if that is killed. While it lives, the
/// environment variable XAUTHORITY of the program names the file of the cookie.
class VirtualDisplay {
 public:
  /// Waits until the server is ready, 30 seconds at most.
  /// @throws InputError  if Xvfb is not installed or does not start, or as TemporaryFolder.
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// ":99", as DISPLAY has it.
  const std::string& name() const { return name_; }
  pid_t server() const { return server_; }

 private:
  TemporaryFolder folder_;  ///< of the cookie
  std::optional<std::string> authority_before_;
  pid_t server_ = -1;
  std::string name_;
};

/// Sends what this process writes to stderr to /dev/null while it lives: software renderers report
/// there.
class SilentStderr {
 public:
  SilentStderr();
  ~SilentStderr();
  SilentStderr(const SilentStderr&) = delete;
  SilentStderr& operator=(const SilentStderr&) = delete;

 private:
  int saved_ = -1;  // descriptor of the stderr before; -1: it was not redirected
};

}  // namespace mesamis
