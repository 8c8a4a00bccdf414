// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace mesamis::detail {

/// A connection to an X display that can render OpenGL.
class Display {
 public:
  /// @param name  as ":99"; empty: the one that the environment variable DISPLAY names.
  /// @throws DisplayError  if the display cannot be opened or has no GLX, without which VTK would
  ///                       end the process.
  explicit Display(const std::string& name);
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  /// Xlib's Display*.
  void* connection() const { return connection_; }

 private:
  void* connection_ = nullptr;
};

}  // namespace mesamis::detail
