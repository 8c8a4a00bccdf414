// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

namespace mesamis::detail {

/// A connection to an X display that can render OpenGL: the one DISPLAY names, else an Xvfb of
/// our own (no TCP, a number the server picks), which ends with this object or with the process.
class XDisplay {
 public:
  /// @throws InputError  if there is neither a display nor an Xvfb that starts.
  XDisplay();
  ~XDisplay();
  XDisplay(const XDisplay&) = delete;
  XDisplay& operator=(const XDisplay&) = delete;

  void* connection() const { return connection_; }  ///< Xlib's Display*

 private:
  void* connection_ = nullptr;
  pid_t server_ = -1;
};

/// While it lives, what this process writes to stderr goes nowhere: the software renderer under
/// OpenGL reports there, whatever its caller wants.
class SilentStderr {
 public:
  SilentStderr();
  ~SilentStderr();
  SilentStderr(const SilentStderr&) = delete;
  SilentStderr& operator=(const SilentStderr&) = delete;

 private:
  int before_ = -1;
};

}  // namespace mesamis::detail
