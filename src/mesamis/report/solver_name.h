// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <string>

#include "mesamis/mesh/finite_elements.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::report {

/// A text as solvers take names, if it begins with a letter: letters, digits and underscores, cut
/// where it is too long. As in the names of files, a character of UTF-8 becomes one underscore.
inline std::string solver_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0) == 0x80) continue;  // not the first of its character
    name += byte < 0x80 && std::isalnum(byte) != 0 ? c : '_';
  }
  return name.substr(0, kLongestSolverName);
}

}  // namespace mesamis::detail::report
