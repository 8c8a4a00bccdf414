// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <string>

#include "mesamis/mesh/finite_elements.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::report {

/// A text as solvers take names, if it begins with a letter: letters, digits and underscores, cut
/// where it is too long.
inline std::string solver_name(std::string text) {
  for (char& c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return text.substr(0, kLongestSolverName);
}

}  // namespace mesamis::detail::report
