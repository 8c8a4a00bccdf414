// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/display.h"

#include <X11/Xlib.h>

#include "mesamis/picture/picture.h"

namespace mesamis::detail {
namespace {

[[noreturn]] void refuse(const std::string& name, const char* reason) {
  // XDisplayName reads the environment for an empty name.
  const std::string tried = XDisplayName(name.c_str());
  throw DisplayError("picture: expected an X display with GLX to draw on, " +
                     (tried.empty() ? "DISPLAY is not set" : "'" + tried + "' " + reason));
}

}  // namespace

Display::Display(const std::string& name) {
  ::Display* display = XOpenDisplay(name.empty() ? nullptr : name.c_str());
  if (display == nullptr) refuse(name, "cannot be opened");
  int opcode = 0, event = 0, error = 0;
  if (!XQueryExtension(display, "GLX", &opcode, &event, &error)) {
    XCloseDisplay(display);
    refuse(name, "has no GLX");
  }
  connection_ = display;
}

Display::~Display() { XCloseDisplay(static_cast<::Display*>(connection_)); }

}  // namespace mesamis::detail
